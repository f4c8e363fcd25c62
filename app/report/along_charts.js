"use strict";

// Opening and pressure along the cracks of a 2D body, at the time that the fields show.

class AlongCharts {
  constructor(holder, frames, colours) {
    [this.holder, this.frames, this.colours] = [holder, frames, colours];
    this.charts = new Map();
  }

  // The ranges over all frames, so that charts of different times compare; unit by its display.
  fieldOf(set, name) {
    const view = this.frames.data.views.find((one) => one.name === set.name);
    return view && view.fields.find((field) => field.name === name);
  }

  reach(set) {
    const ends = set.frames.filter((frame) => frame && frame.paths)
      .map(({ paths: { along } }) => [along.low, along.low + along.step * along.top]);
    return [Math.min(...ends.map((end) => end[0])), Math.max(...ends.map((end) => end[1]))];
  }

  chart(crack, what) {
    const field = this.fieldOf(crack.set, crack[`${what}Name`]);
    if (!field || !crack.along) return null;
    const branches = [...new Set(crack.frame.paths.branch)];
    const series = branches.map((branch, n) => {
      const members = crack.frame.paths.branch.map((b, i) => i).filter((i) => crack.frame.paths.branch[i] === branch)
        .sort((i, j) => crack.along[i] - crack.along[j]);
      const finite = (value) => (Number.isFinite(value) ? value : null);
      return { label: branches.length > 1 ? `crack ${n + 1}` : field.label, group: n, markers: false,
               x: members.map((i) => finite(crack.along[i])), y: members.map((i) => finite(crack[what][i])) };
    });
    const { factor, unit } = this.frames.data.length;
    const [from, to] = this.reach(crack.set).map((end) => end * factor);
    const room = 0.03 * (to - from) || 1;
    const [low, high] = [Math.min(field.low, 0) * field.factor, Math.max(field.high, 0) * field.factor];
    return {
      title: `${field.label[0].toUpperCase()}${field.label.slice(1)} along the crack`, kind: "along", logX: false, logY: false, start: 0,
      ordered: false, groups: branches.length, series, height: 250,
      x: { label: `from the oldest facet [${unit}]`, factor, unit },
      y: { label: field.unit ? `${field.label} [${field.unit}]` : field.label, factor: field.factor, unit: field.unit },
      xRange: [from - room, to + room], yRange: [low - 0.04 * (high - low), high + 0.06 * (high - low) || 1],
    };
  }

  show(cracks) {
    for (const crack of cracks) {
      for (const what of ["opening", "pressure"]) {
        const chart = crack[`${what}Name`] && this.chart(crack, what);
        if (!chart) continue;
        const key = `${crack.name} ${what}`;
        if (this.charts.has(key)) {
          this.charts.get(key).update(chart);
          continue;
        }
        const place = document.createElement("div");
        place.className = "chart";
        this.holder.append(place);
        this.charts.set(key, new ChartView(place, chart, this.colours));
      }
    }
    this.holder.hidden = !this.charts.size;
  }

  redraw() { for (const chart of this.charts.values()) chart.draw(); }
}
