"use strict";

// Error against cost, drawn on uPlot's axes: curves keep the order of their axis, which uPlot's own do not.

const study = JSON.parse(document.getElementById("study-data").textContent);
const styleValue = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const colourOf = (curve) => styleValue(`--series-${curve.colour % 7}`);
const DASHES = [[], [6, 4], [2, 3], [8, 3, 2, 3]];
const NEAR = 24; // pixels

const superscript = (integer) => [...String(integer)].map((c) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[c] ?? "⁻").join("");

function decade(value) {
  const exponent = value === null ? NaN : Math.log10(value);
  return Math.abs(exponent - Math.round(exponent)) < 1e-9 ? `10${superscript(Math.round(exponent))}` : "";
}

// uPlot asks with the limits of the data for all there is, with others where it was zoomed in.
function zoomed(low, high, values, all) {
  return low === Math.min(...values) && high === Math.max(...values) ? all : [low, high];
}

class StudyChart {
  constructor(chart) {
    this.chart = chart;
    this.points = chart.curves.flatMap((curve) => curve.points.map((point) => ({ ...point, curve })));
    this.holder = document.createElement("div");
    this.holder.className = "chart";
    this.area = document.createElement("div");
    this.tip = document.createElement("div");
    this.tip.className = "tip";
    this.tip.hidden = true;
    const title = document.createElement("h3");
    title.textContent = chart.title;
    this.holder.append(title, this.area, this.legend(), this.tip);
    document.getElementById("charts").append(this.holder);
    this.draw();
  }

  legend() {
    const list = document.createElement("ul");
    list.className = "curves";
    for (const curve of this.chart.curves) {
      const entry = document.createElement("li");
      const swatch = document.createElement("span");
      swatch.style.background = colourOf(curve);
      entry.append(swatch, curve.label);
      list.append(entry);
    }
    return list;
  }

  axis(label, size) {
    const line = { stroke: styleValue("--line"), width: 1 };
    return { label, stroke: styleValue("--ink"), size, grid: line, ticks: line, labelSize: 22,
      values: (_, splits) => splits.map(decade) };
  }

  draw() {
    if (this.plot) this.plot.destroy();
    const drawn = this.points.filter((point) => point.y > 0).sort((a, b) => a.x - b.x);
    if (!drawn.length) return;
    // uPlot gets the points for its scales only; a margin keeps them off the edges.
    const xs = this.points.map((point) => point.x), ys = drawn.map((point) => point.y);
    const margin = (values, above) => [Math.min(...values) / 1.6, Math.max(...values) * above];
    const known = drawn.map((point) => point.x);
    const width = this.holder.clientWidth;
    this.plot = new uPlot({
      width, height: Math.max(320, Math.min(480, 0.55 * width)),
      legend: { show: false },
      scales: { x: { time: false, distr: 3, range: (_, low, high) => zoomed(low, high, known, margin(xs, 1.6)) },
        y: { distr: 3, range: (_, low, high) => zoomed(low, high, ys, margin(ys, 3)) } },
      axes: [this.axis(this.chart.xLabel, 36), this.axis(this.chart.yLabel, 58)],
      series: [{}, { paths: () => null, points: { show: false } }],
      cursor: { drag: { x: true, y: true }, points: { show: false } },
      hooks: { draw: [(plot) => this.paint(plot)], setCursor: [(plot) => this.read(plot)] },
    }, [known, ys], this.area);
  }

  // What has no error stands at the upper edge, an error of 0 at the lower one.
  place(plot, point) {
    const x = plot.valToPos(point.x, "x", true);
    if (point.y > 0) return [x, plot.valToPos(point.y, "y", true)];
    const edge = 12 * devicePixelRatio;
    return [x, point.y === null ? plot.bbox.top + edge : plot.bbox.top + plot.bbox.height - edge];
  }

  paint(plot) {
    const context = plot.ctx;
    context.save();
    context.beginPath();
    context.rect(plot.bbox.left, plot.bbox.top, plot.bbox.width, plot.bbox.height);
    context.clip();
    this.chart.fronts.forEach((front) => this.paintFront(plot, front));
    for (const curve of this.chart.curves) this.paintCurve(plot, curve);
    context.restore();
  }

  paintFront(plot, front) {
    const context = plot.ctx;
    context.beginPath();
    front.forEach((point, i) => {
      const [x, y] = this.place(plot, point);
      if (i > 0) context.lineTo(x, this.place(plot, front[i - 1])[1]);
      context.lineTo(x, y);
    });
    context.lineWidth = 5 * devicePixelRatio;
    context.strokeStyle = styleValue("--line");
    context.stroke();
  }

  paintCurve(plot, curve) {
    const context = plot.ctx;
    context.strokeStyle = context.fillStyle = colourOf(curve);
    context.lineWidth = 1.6 * devicePixelRatio;
    context.setLineDash(DASHES[curve.style % DASHES.length].map((length) => length * devicePixelRatio));
    context.beginPath();
    const joined = curve.points.filter((point) => point.y > 0);
    if (curve.joined) joined.forEach((point) => context.lineTo(...this.place(plot, point)));
    context.stroke();
    context.setLineDash([]);
    for (const point of curve.points) this.paintPoint(plot, curve, point);
  }

  paintPoint(plot, curve, point) {
    const context = plot.ctx, size = 4.5 * devicePixelRatio;
    const [x, y] = this.place(plot, point);
    context.beginPath();
    if (point.y === null) {
      context.moveTo(x - size, y - size); context.lineTo(x + size, y + size);
      context.moveTo(x - size, y + size); context.lineTo(x + size, y - size);
      context.stroke();
      return;
    }
    context.moveTo(plot.valToPos(point.least, "x", true), y);
    context.lineTo(plot.valToPos(point.most, "x", true), y);
    context.stroke();
    context.beginPath();
    context.arc(x, y, size, 0, 2 * Math.PI);
    context.fillStyle = point.best ? colourOf(curve) : styleValue("--ground");
    context.fill();
    context.stroke();
  }

  read(plot) {
    const { left, top } = plot.cursor;
    let nearest = null, least = NEAR;
    for (const point of this.points) {
      const [x, y] = this.place(plot, point);
      const away = Math.hypot((x - plot.bbox.left) / devicePixelRatio - left, (y - plot.bbox.top) / devicePixelRatio - top);
      if (away < least) [nearest, least] = [point, away];
    }
    this.tip.hidden = !nearest || left < 0;
    if (this.tip.hidden) return;
    const name = document.createElement("b");
    name.textContent = nearest.name;
    this.tip.replaceChildren(name, ...nearest.lines.map((text) => {
      const line = document.createElement("div");
      line.textContent = text;
      return line;
    }));
    const right = left > plot.over.clientWidth / 2;
    this.tip.style.left = right ? "" : `${left + plot.over.offsetLeft + 16}px`;
    this.tip.style.right = right ? `${plot.over.clientWidth - left + 16}px` : "";
    this.tip.style.top = `${top + 24}px`;
  }
}

const charts = study.charts.map((chart) => new StudyChart(chart));
const redraw = () => charts.forEach((chart) => chart.draw());
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
addEventListener("resize", redraw);
