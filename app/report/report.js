"use strict";

// Puts the run's data into the page: charts into their holders, frames behind the controls.

const embedded = JSON.parse(document.getElementById("run-data").textContent);

const charts = [...document.querySelectorAll("[data-chart]")].map(
  (holder) => new ChartView(holder, embedded.charts[Number(holder.dataset.chart)], embedded.palettes.sequential));

function redrawCharts() { charts.forEach((chart) => chart.draw()); }
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redrawCharts);
let chartWidth = innerWidth;
addEventListener("resize", () => {
  if (innerWidth !== chartWidth) { chartWidth = innerWidth; redrawCharts(); }
});

// One run, or two side by side whose times go together.
const roots = [...document.querySelectorAll("[data-fields]")];
const views = embedded.runs.map((run) => {
  if (!run.fields) return null;
  const store = new ChunkStore((key) => fromBase64(run.chunks[key]));
  const root = roots.shift();
  return new FieldsView(root, run.fields, store, embedded.palettes, (time, view) => onTime(time, view));
});

if (views.length === 2 && views[0] && views[1]) [views[0].peer, views[1].peer] = [views[1], views[0]];

function onTime(time, from) {
  charts.forEach((chart) => chart.mark(time));
  for (const view of views || []) if (view && view !== from) view.goToTime(time);
}
