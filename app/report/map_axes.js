"use strict";

// Round ticks, and the frame of a map with its axes.

function roundTicks(low, high, most) {
  const rough = (high - low) / Math.max(most, 1);
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find((round) => round * power >= rough * 0.999);
  const ticks = [];
  for (let n = Math.ceil(low / step - 1e-9); n * step <= high + 1e-9 * step; ++n) ticks.push(Number((n * step).toPrecision(12)));
  return ticks;
}

const MARGIN = { left: 58, right: 12, top: 10, bottom: 44 };

// Where a box of the run lies on a canvas: places in CSS pixels from lengths in SI.
class MapFrame {
  constructor(canvas, box, across, up, tallest) {
    this.canvas = canvas;
    [this.across, this.up] = [across, up];
    const [left, right] = [box.low[across], box.high[across]], [bottom, top] = [box.low[up], box.high[up]];
    const wide = (right - left) || 1, tall = (top - bottom) || 1;
    this.width = Math.max(canvas.clientWidth, 160);
    const room = this.width - MARGIN.left - MARGIN.right;
    // A column a few points wide is drawn wider than it is: its map is about the other direction.
    const equal = wide / tall > 1 / 6 && wide / tall < 6;
    const scale = Math.min(room / wide, tallest / tall);
    this.scaleX = equal ? scale : Math.min(room, Math.max(scale * wide, 0.3 * room)) / wide;
    this.scaleY = equal ? scale : Math.max(scale * tall, Math.min(120, tallest)) / tall;
    this.box = { left, right, bottom, top };
    this.offset = MARGIN.left + (room - this.scaleX * wide) / 2;
    this.bottom = MARGIN.top + this.scaleY * tall;
    this.height = this.bottom + MARGIN.bottom;
    const ratio = devicePixelRatio || 1;
    canvas.style.height = `${this.height}px`;
    canvas.width = Math.round(this.width * ratio);
    canvas.height = Math.round(this.height * ratio);
    this.context = canvas.getContext("2d");
    this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.context.clearRect(0, 0, this.width, this.height);
  }

  column(x) { return this.offset + (x - this.box.left) * this.scaleX; }
  row(y) { return this.bottom - (y - this.box.bottom) * this.scaleY; }
  place(px, py) { return [this.box.left + (px - this.offset) / this.scaleX, this.box.bottom + (this.bottom - py) / this.scaleY]; }

  clip() {
    const { left, right } = this.box;
    this.context.save();
    this.context.beginPath();
    this.context.rect(this.column(left) - 9, MARGIN.top - 9, this.scaleX * (right - left) + 18, this.bottom - MARGIN.top + 18);
    this.context.clip();
  }

  drawAxes(names, length) {
    const { context } = this;
    const { left, right, bottom, top } = this.box;
    const ink = styleValue("--ink"), faint = styleValue("--faint");
    context.font = '12px system-ui, "DejaVu Sans", sans-serif';
    context.strokeStyle = faint;
    context.fillStyle = ink;
    context.lineWidth = 1;
    const edgeLeft = this.column(left), edgeRight = this.column(right), edgeTop = this.row(top);
    context.strokeRect(edgeLeft, edgeTop, edgeRight - edgeLeft, this.bottom - edgeTop);
    context.textAlign = "center";
    context.textBaseline = "top";
    for (const tick of roundTicks(left * length.factor, right * length.factor, (edgeRight - edgeLeft) / 70)) {
      const x = this.column(tick / length.factor);
      context.fillRect(x - 0.5, this.bottom, 1, 5);
      context.fillText(shortNumber(tick), x, this.bottom + 7);
    }
    context.fillText(`${names[0]} [${length.unit}]`, (edgeLeft + edgeRight) / 2, this.bottom + 25);
    context.textAlign = "right";
    context.textBaseline = "middle";
    for (const tick of roundTicks(bottom * length.factor, top * length.factor, (this.bottom - edgeTop) / 45)) {
      const y = this.row(tick / length.factor);
      context.fillRect(edgeLeft - 5, y - 0.5, 5, 1);
      context.fillText(shortNumber(tick), edgeLeft - 8, y);
    }
    context.save();
    context.translate(edgeLeft - 46, (this.bottom + edgeTop) / 2);
    context.rotate(-Math.PI / 2);
    context.textAlign = "center";
    context.fillText(`${names[1]} [${length.unit}]`, 0, 0);
    context.restore();
  }
}
