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
  frame.decodedPoints ??= { x: decoded(frame.points.x), y: decoded(frame.points.y) };
  return frame.decodedPoints;
}

function extent(series) {
  if (series.extent) return series.extent;
  const box = { left: Infinity, right: -Infinity, bottom: Infinity, top: -Infinity };
  series.frames.forEach((frame, place) => {
    if (!frame.points) return;
    const points = framePoints(series, place);
    for (const x of points.x) { box.left = Math.min(box.left, x); box.right = Math.max(box.right, x); }
    for (const y of points.y) { box.bottom = Math.min(box.bottom, y); box.top = Math.max(box.top, y); }
  });
  const half = series.spacing / 2;
  series.extent = { left: box.left - half, right: box.right + half, bottom: box.bottom - half, top: box.top + half };
  return series.extent;
}

function rangeOf(values) {
  let low = Infinity, high = -Infinity;
  for (const v of values) if (Number.isFinite(v)) { low = Math.min(low, v); high = Math.max(high, v); }
  return low <= high ? { low, high } : { low: 0, high: 0 };
}

class PointMap {
  constructor(canvas, colours) {
    this.canvas = canvas;
    this.colours = colours.map((rgb) => `rgb(${rgb.join(",")})`);
  }

  // Shows `field` of frame `place`; returns the range of its colours, in SI.
  show(series, place, field, ownRange) {
    this.series = series;
    this.points = framePoints(series, place);
    const text = series.frames[place].values[field.name];
    this.values = text === undefined ? new Float32Array(this.points.x.length).fill(NaN) : decoded(text);
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
    const half = this.series.spacing / 2;
    const column = (x) => Math.round(this.offset + (x - box.left) * this.scale);
    const row = (y) => Math.round((box.top - y) * this.scale);
    for (let i = 0; i < this.values.length; ++i) {
      const v = this.values[i];
      if (!Number.isFinite(v)) continue;
      const share = high > low ? (v - low) / (high - low) : 0.5;
      context.fillStyle = this.colours[Math.round(255 * Math.min(Math.max(share, 0), 1))];
      const left = column(this.points.x[i] - half), top = row(this.points.y[i] + half);
      const right = column(this.points.x[i] + half), bottom = row(this.points.y[i] - half);
      context.fillRect(left, top, Math.max(right - left, 1), Math.max(bottom - top, 1));
    }
  }

  // Index of the point under the mouse, or -1.
  pointAt(event) {
    const box = extent(this.series);
    const x = box.left + (event.offsetX * this.ratio - this.offset) / this.scale;
    const y = box.top - (event.offsetY * this.ratio) / this.scale;
    let nearest = -1, least = this.series.spacing ** 2;
    for (let i = 0; i < this.points.x.length; ++i) {
      const distance = (this.points.x[i] - x) ** 2 + (this.points.y[i] - y) ** 2;
      if (distance < least) { least = distance; nearest = i; }
    }
    return nearest;
  }
}
