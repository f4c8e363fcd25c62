"use strict";

// Points of one frame as coloured squares on a canvas.

function decoded(text) {
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  return new Float32Array(bytes.buffer);
}

// Frames carry points only where they moved: look back for the last that did.
function framePoints(series, place) {
  while (!series.frames[place].points) --place;
  const frame = series.frames[place];
  frame.decodedPoints ??= { x: decoded(frame.points.x), y: decoded(frame.points.y), edge: decoded(frame.points.edge) };
  return frame.decodedPoints;
}

function extent(series) {
  if (series.extent) return series.extent;
  const box = { left: Infinity, right: -Infinity, bottom: Infinity, top: -Infinity };
  series.frames.forEach((frame, place) => {
    if (!frame.points) return;
    const points = framePoints(series, place);
    points.edge.forEach((edge, i) => {
      box.left = Math.min(box.left, points.x[i] - edge / 2);
      box.right = Math.max(box.right, points.x[i] + edge / 2);
      box.bottom = Math.min(box.bottom, points.y[i] - edge / 2);
      box.top = Math.max(box.top, points.y[i] + edge / 2);
    });
  });
  series.extent = box;
  return box;
}

function rangeOf(values) {
  let low = Infinity, high = -Infinity;
  for (const v of values) if (Number.isFinite(v)) { low = Math.min(low, v); high = Math.max(high, v); }
  return low <= high ? { low, high } : { low: 0, high: 0 };
}

// What a point is drawn in where the field is not there, as the water's velocity in rock.
const ABSENT = "#9aa5b1";

class PointMap {
  constructor(canvas, colours) {
    this.canvas = canvas;
    this.colours = colours.map((rgb) => `rgb(${rgb.join(",")})`);
  }

  // Shows `field` of frame `place`; returns the range of its colours, in SI.
  show(series, place, field, ownRange, arrows) {
    this.series = series;
    this.points = framePoints(series, place);
    const valuesOf = (name) => {
      const text = series.frames[place].values[name];
      return text === undefined ? new Float32Array(this.points.x.length).fill(NaN) : decoded(text);
    };
    this.values = valuesOf(field.name);
    this.velocity = arrows ? series.velocity.map(valuesOf) : [];
    this.range = ownRange ? rangeOf(this.values) : { low: field.low, high: field.high };
    this.draw();
    return this.range;
  }

  fit() {
    const box = extent(this.series);
    const width = this.canvas.clientWidth;
    const scale = Math.min(width / (box.right - box.left), 560 / (box.top - box.bottom));
    const ratio = devicePixelRatio || 1;
    const height = scale * (box.top - box.bottom);
    this.canvas.style.height = `${height}px`;
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    this.scale = scale * ratio;
    this.ratio = ratio;
    this.offset = (this.canvas.width - this.scale * (box.right - box.left)) / 2;
  }

  draw() {
    this.fit();
    const context = this.canvas.getContext("2d");
    const box = extent(this.series);
    const { low, high } = this.range;
    const column = (x) => Math.round(this.offset + (x - box.left) * this.scale);
    const row = (y) => Math.round((box.top - y) * this.scale);
    for (let i = 0; i < this.values.length; ++i) {
      const v = this.values[i];
      const half = this.points.edge[i] / 2;
      const share = high > low ? (v - low) / (high - low) : 0.5;
      context.fillStyle = Number.isFinite(v) ? this.colours[Math.round(255 * Math.min(Math.max(share, 0), 1))] : ABSENT;
      const left = column(this.points.x[i] - half), top = row(this.points.y[i] + half);
      const right = column(this.points.x[i] + half), bottom = row(this.points.y[i] - half);
      context.fillRect(left, top, Math.max(right - left, 1), Math.max(bottom - top, 1));
    }
    this.fastest = 0;
    if (this.velocity.length) this.drawArrows(context, box);
  }

  // Velocities of one point in each cell of a grid; the fastest is two cells long.
  drawArrows(context, box) {
    const [u, v] = this.velocity;
    const speed = u.map((_, i) => Math.hypot(u[i], v[i]));
    const fastest = rangeOf(speed).high;
    this.fastest = fastest;
    if (!(fastest > 0)) return;
    const cell = Math.max(box.right - box.left, box.top - box.bottom) / 30;
    const taken = new Set();
    context.strokeStyle = styleValue("--ink");
    context.lineWidth = 1.2 * this.ratio;
    context.beginPath();
    for (let i = 0; i < speed.length; ++i) {
      const { x, y } = this.points;
      const key = `${Math.floor(x[i] / cell)} ${Math.floor(y[i] / cell)}`;
      if (!(speed[i] > 0.01 * fastest) || taken.has(key)) continue;
      taken.add(key);
      const length = (2 * cell * this.scale) / fastest;
      const from = [this.offset + (x[i] - box.left) * this.scale, (box.top - y[i]) * this.scale];
      const to = [from[0] + u[i] * length, from[1] - v[i] * length];
      const back = Math.atan2(from[1] - to[1], from[0] - to[0]);
      const head = 0.3 * Math.hypot(to[0] - from[0], to[1] - from[1]);
      context.moveTo(...from);
      context.lineTo(...to);
      for (const turn of [-0.45, 0.45]) {
        context.moveTo(...to);
        context.lineTo(to[0] + head * Math.cos(back + turn), to[1] + head * Math.sin(back + turn));
      }
    }
    context.stroke();
  }

  // Index of the point under the mouse, or -1.
  pointAt(event) {
    const box = extent(this.series);
    const x = box.left + (event.offsetX * this.ratio - this.offset) / this.scale;
    const y = box.top - (event.offsetY * this.ratio) / this.scale;
    let nearest = -1, least = 1;
    for (let i = 0; i < this.points.x.length; ++i) {
      const distance = ((this.points.x[i] - x) ** 2 + (this.points.y[i] - y) ** 2) / this.points.edge[i] ** 2;
      if (distance < least) { least = distance; nearest = i; }
    }
    return nearest;
  }
}
