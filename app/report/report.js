"use strict";

// Puts the run's data into the page: charts into their holders, frames behind the map's controls.

const run = JSON.parse(document.getElementById("run-data").textContent);
const element = (name) => document.getElementById(`map-${name}`);

function drawCharts() {
  const views = [...document.querySelectorAll("[data-chart]")].map(
    (holder) => new ChartView(holder, run.charts[Number(holder.dataset.chart)], run.colours));
  const redraw = () => views.forEach((view) => view.draw());
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
  addEventListener("resize", redraw);
}

function fillSelect(select, labels) {
  select.replaceChildren(...labels.map((label, i) => new Option(label, String(i))));
  select.closest("label").hidden = labels.length < 2 && select.id === "map-series";
}

function drawBar(bar) {
  const stops = run.colours.filter((_, i) => i % 15 === 0).map((rgb) => `rgb(${rgb.join(",")})`);
  bar.style.background = `linear-gradient(to top, ${stops.join(",")})`;
}

class MapControls {
  constructor() {
    this.map = new PointMap(element("canvas"), run.colours);
    drawBar(element("bar"));
    fillSelect(element("series"), run.series.map((series) => series.name));
    element("series").addEventListener("change", () => this.chooseSeries());
    for (const name of ["field", "rescale", "arrows"]) element(name).addEventListener("change", () => this.show());
    element("time").addEventListener("input", () => this.show());
    element("play").addEventListener("click", () => this.play(!this.timer));
    element("canvas").addEventListener("mousemove", (event) => this.read(event));
    element("canvas").addEventListener("mouseleave", () => this.describe());
    addEventListener("resize", () => this.show());
    this.chooseSeries();
  }

  chooseSeries() {
    this.series = run.series[Number(element("series").value)];
    const fields = this.series.fields;
    fillSelect(element("field"), fields.map((field) => field.label));
    element("field").value = String(Math.max(fields.findIndex((field) => field.name.includes("pressure")), 0));
    element("time").max = String(this.series.frames.length - 1);
    element("time").value = element("time").max;
    element("note").textContent = this.series.note;
    element("arrows").closest("label").hidden = !this.series.velocity.length;
    this.show();
  }

  get field() { return this.series.fields[Number(element("field").value)]; }
  get place() { return Number(element("time").value); }
  get label() { return this.series.frames[this.place].label; }

  shown(value) { return `${shortNumber(value * this.field.factor)} ${this.field.unit}`.trim(); }

  show() {
    if (!this.field) return;
    const [ownRange, arrows] = ["rescale", "arrows"].map((name) => element(name).checked);
    const range = this.map.show(this.series, this.place, this.field, ownRange, arrows);
    element("high").textContent = this.shown(range.high);
    element("low").textContent = this.shown(range.low);
    element("now").textContent = `t = ${this.label}`;
    element("time").setAttribute("aria-valuetext", this.label);
    this.describe();
  }

  describe() {
    const { low, high } = rangeOf(this.map.values);
    const range = `from ${this.shown(low)} to ${this.shown(high)}`;
    const arrows = this.map.fastest > 0 ? ` Longest arrow: ${shortNumber(this.map.fastest)} m/s.` : "";
    element("readout").textContent = `${this.field.label} at t = ${this.label}: ${range}.${arrows}`;
  }

  read(event) {
    const at = this.map.pointAt(event);
    if (at < 0) return this.describe();
    const { factor, unit } = this.series.length;
    const [x, y] = ["x", "y"].map((axis) => `${shortNumber(this.map.points[axis][at] * factor)} ${unit}`);
    const [across, up] = this.series.axes;
    element("readout").textContent = `${across} = ${x}, ${up} = ${y}: ${this.field.label} ${this.shown(this.map.values[at])}`;
  }

  play(on) {
    clearInterval(this.timer);
    this.timer = on ? setInterval(() => this.step(), 400) : null;
    element("play").textContent = on ? "pause" : "play";
    element("play").setAttribute("aria-pressed", String(on));
  }

  step() {
    element("time").value = String((this.place + 1) % this.series.frames.length);
    this.show();
  }
}

drawCharts();
if (run.series.length) new MapControls();
