"use strict";

// One chart of the run, drawn by uPlot. Values come in SI; each axis brings its display factor.

const styleValue = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

function seriesColour(chart, group, colours) {
  if (!chart.ordered) return styleValue(`--series-${group % 7}`);
  // The darkest end of the map sinks into a dark ground, the lightest into a light one.
  const dark = matchMedia("(prefers-color-scheme: dark)").matches;
  const [first, last] = dark ? [0.3, 1.0] : [0.05, 0.85];
  const at = first + ((last - first) * group) / Math.max(chart.groups - 1, 1);
  return colours[Math.round(255 * at)];
}

// Curves with their own places along x become one table, as uPlot wants it.
function chartTable(chart, logX) {
  const tables = chart.series.map((series) => {
    const kept = series.x.map((x, i) => i).filter((i) => series.x[i] !== null && (!logX || series.x[i] > chart.start));
    kept.sort((i, j) => series.x[i] - series.x[j]);
    const scaled = (values, factor) => kept.map((i) => (values[i] === null ? null : values[i] * factor));
    return [scaled(series.x, chart.x.factor), scaled(series.y, chart.y.factor)];
  });
  return uPlot.join(tables);
}

const shortNumber = (value) => (value === null || value === undefined ? "" : String(Number(value.toPrecision(4))));

// Markers far enough apart that the curve shows between them; zooming in brings more.
function spacedPoints(plot, seriesIndex) {
  const chosen = [];
  let last = -Infinity;
  plot.data[0].forEach((x, i) => {
    const at = plot.valToPos(x, "x");
    if (plot.data[seriesIndex][i] == null || at - last < 18) return;
    chosen.push(i);
    last = at;
  });
  return chosen;
}

function chartSeries(chart, series, colours) {
  const colour = seriesColour(chart, series.group, colours);
  const compared = chart.kind !== "error" && series.markers;
  return {
    label: series.label,
    class: compared ? "computed" : "curve",
    stroke: colour,
    width: 1.8,
    dash: series.dashed ? [7, 4] : undefined,
    spanGaps: true,
    paths: compared ? () => null : undefined,
    points: {
      show: series.markers, size: 6, width: 1.4, stroke: colour, fill: compared ? styleValue("--ground") : colour,
      filter: compared ? spacedPoints : undefined,
    },
    value: (_, value) => shortNumber(value),
  };
}

const superscript = (integer) => [...String(integer)].map((c) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[c] ?? "⁻").join("");

// A logarithmic axis names its decades only.
function decade(value) {
  const exponent = value === null ? NaN : Math.log10(value);
  return Math.abs(exponent - Math.round(exponent)) < 1e-9 ? `10${superscript(Math.round(exponent))}` : "";
}

function chartAxis(axis, log, size) {
  const line = { stroke: styleValue("--line"), width: 1 };
  const sans = 'system-ui, "DejaVu Sans", sans-serif';
  return {
    label: axis.label, labelFont: `14px ${sans}`, labelSize: 22, labelGap: 2,
    font: `13px ${sans}`, stroke: styleValue("--ink"), size, grid: line, ticks: line,
    values: (_, splits) => splits.map(log ? decade : shortNumber),
  };
}

// A line at the time that the fields show.
function drawMark(plot, time) {
  const { min, max } = plot.scales.x;
  if (time === undefined || time < min || time > max) return;
  const { ctx, bbox } = plot;
  const x = Math.round(plot.valToPos(time, "x", true));
  ctx.save();
  ctx.strokeStyle = styleValue("--focus");
  ctx.lineWidth = 1.5 * (devicePixelRatio || 1);
  ctx.setLineDash([5, 4].map((length) => length * (devicePixelRatio || 1)));
  ctx.beginPath();
  ctx.moveTo(x, bbox.top);
  ctx.lineTo(x, bbox.top + bbox.height);
  ctx.stroke();
  ctx.restore();
}

function chartOptions(chart, colours, width, logX, mark) {
  return {
    width,
    height: chart.height || Math.max(280, Math.min(420, 0.5 * width)),
    hooks: { draw: [(plot) => drawMark(plot, mark())] },
    scales: {
      x: { time: false, distr: logX ? 3 : 1, ...(chart.xRange ? { range: () => chart.xRange } : {}) },
      y: { distr: chart.logY ? 3 : 1, ...(chart.yRange ? { range: () => chart.yRange } : {}) },
    },
    axes: [chartAxis(chart.x, logX, 36), chartAxis(chart.y, chart.logY, 58)],
    series: [
      { label: chart.x.label, value: (_, value) => shortNumber(value) },
      ...chart.series.map((series) => chartSeries(chart, series, colours)),
    ],
    cursor: { points: { size: 9 } },
  };
}

// The legend switches curves by mouse; this lets Enter and space do it too.
function makeLegendReachable(plot) {
  plot.root.querySelectorAll(".u-legend .u-series").forEach((row, i) => {
    if (i === 0) return;
    const name = row.querySelector("th");
    name.tabIndex = 0;
    name.setAttribute("role", "switch");
    name.setAttribute("aria-checked", "true");
    const sync = () => name.setAttribute("aria-checked", String(plot.series[i].show));
    name.addEventListener("click", () => requestAnimationFrame(sync));
    name.addEventListener("keydown", (event) => {
      if (event.key !== "Enter" && event.key !== " ") return;
      event.preventDefault();
      event.stopPropagation();
      plot.setSeries(i, { show: !plot.series[i].show });
      sync();
    });
  });
}

function moveCursor(plot, step) {
  const x = plot.data[0];
  const inside = (i) => x[i] >= plot.scales.x.min && x[i] <= plot.scales.x.max;
  let at = plot.cursor.idx ?? (step > 0 ? -1 : x.length);
  do at += step;
  while (at > 0 && at < x.length - 1 && !inside(at));
  at = Math.min(Math.max(at, 0), x.length - 1);
  plot.setCursor({ left: plot.valToPos(x[at], "x"), top: plot.over.clientHeight / 2 });
}

class ChartView {
  constructor(holder, chart, colours) {
    this.holder = holder;
    this.chart = chart;
    this.colours = colours;
    this.logX = chart.logX;
    const title = document.createElement("h3");
    title.textContent = chart.title;
    this.area = document.createElement("div");
    this.area.tabIndex = 0;
    this.area.setAttribute("role", "group");
    this.area.setAttribute("aria-label", `${chart.title}; left and right arrow keys read the values`);
    this.area.addEventListener("keydown", (event) => this.onKey(event));
    holder.append(title, this.area);
    if (chart.logX && chart.kind !== "error") holder.append(this.logSwitch());
    this.draw();
  }

  logSwitch() {
    const label = document.createElement("label");
    const box = document.createElement("input");
    box.type = "checkbox";
    box.checked = this.logX;
    box.addEventListener("change", () => { this.logX = box.checked; this.draw(); });
    label.className = "note";
    label.append(box, " logarithmic time");
    return label;
  }

  onKey(event) {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (!step || event.target !== this.area) return;
    event.preventDefault();
    moveCursor(this.plot, step);
  }

  draw() {
    if (this.plot) this.plot.destroy();
    const width = Math.max(this.holder.clientWidth, 200);
    const options = chartOptions(this.chart, this.colours, width, this.logX, () => this.time);
    this.plot = new uPlot(options, chartTable(this.chart, this.logX), this.area);
    makeLegendReachable(this.plot);
  }

  // Another state of the same curves, as of a run that goes on.
  update(chart) {
    this.chart = chart;
    this.holder.querySelector("h3").textContent = chart.title;
    this.draw();
  }

  // Shows `time` [s] as a line, where the chart is over time.
  mark(time) {
    if (this.chart.kind === "profile" || this.chart.kind === "along") return;
    this.time = time * this.chart.x.factor;
    this.plot.redraw(false);
  }
}
