"use strict";

// Points of one frame as coloured squares on a canvas, with cracks, directions of stress and velocities over them.

// What a point is drawn in where the field is not there, as the water's velocity in rock.
const ABSENT = "#9aa5b1";

class FieldMap {
  constructor(canvas) { this.canvas = canvas; }

  // `scene` as FieldFrames.at gives it; `how`: {box, across, up, normal, cut, range, colours, magnify, crosses, cracks,
  // arrows, names, length, tallest}. Returns the longest arrow [m/s] and the largest cross [Pa].
  draw(scene, how) {
    this.how = how;
    this.frame = new MapFrame(this.canvas, how.box, how.across, how.up, how.tallest);
    this.cells = [];
    const told = { fastest: 0, stress: 0 };
    this.frame.clip();
    for (const layer of scene.layers) this.drawLayer(layer);
    if (how.crosses) for (const stress of scene.stresses) told.stress = Math.max(told.stress, this.drawCrosses(stress));
    if (how.cracks) for (const crack of scene.cracks) this.drawCrack(crack, scene.layers);
    if (how.arrows) for (const layer of scene.layers) told.fastest = Math.max(told.fastest, this.drawArrows(layer));
    this.frame.context.restore();
    this.frame.drawAxes(how.names, how.length);
    return told;
  }

  // Whether a point lies in the slice that is shown.
  inSlice(layer, i) {
    const { normal, cut } = this.how;
    if (normal < 0) return true;
    return Math.abs(layer.points[AXES[normal]][i] - cut) <= 0.501 * layer.points.edge[i];
  }

  // Where a point is drawn, moved by its magnified displacement [m].
  at(layer, i) {
    const { across, up, magnify } = this.how;
    const u = layer.displacement;
    const moved = (axis) => layer.points[AXES[axis]][i] + (u && magnify ? magnify * u[axis][i] : 0);
    return [moved(across), moved(up)];
  }

  colour(value) {
    const { range, colours } = this.how;
    if (!Number.isFinite(value)) return ABSENT;
    const share = range.high > range.low ? (value - range.low) / (range.high - range.low) : 0.5;
    return colours[Math.round(255 * Math.min(Math.max(share, 0), 1))];
  }

  drawLayer(layer) {
    const { frame } = this;
    const ratio = devicePixelRatio || 1;
    const lower = (along) => Math.floor(along * ratio + 0.02) / ratio;  // squares overlap by a pixel: no seams
    const upper = (along) => Math.ceil(along * ratio - 0.02) / ratio;
    for (let i = 0; i < layer.count; ++i) {
      if (!this.inSlice(layer, i)) continue;
      const [x, y] = this.at(layer, i);
      const half = (layer.points.edge[i] / 2) * (layer.set.velocity.length ? 1.15 : 1);  // what flows has no gaps
      const left = lower(frame.column(x - half)), right = upper(frame.column(x + half));
      const top = lower(frame.row(y + half)), bottom = upper(frame.row(y - half));
      frame.context.fillStyle = this.colour(layer.values[i]);
      frame.context.fillRect(left, top, Math.max(right - left, 1.5), Math.max(bottom - top, 1.5));
      this.cells.push({ layer, i, x, y, half });
    }
  }

  // Facets lie between points: they move as the nearest point of the body does not, so they are drawn where they were.
  drawCrack(crack) {
    const { frame, how } = this;
    const { context } = frame;
    const place = (i) => [frame.column(crack.points[AXES[how.across]][i]), frame.row(crack.points[AXES[how.up]][i])];
    const lines = how.normal < 0 ? crackLines(crack) : this.slicedFacets(crack);
    for (const [width, dressed] of [[5, false], [2.6, true]]) {
      context.lineWidth = width;
      context.lineCap = "round";
      for (const [a, b] of lines) {
        const wet = !crack.wet || crack.wet[a] > 0.5;
        context.strokeStyle = dressed ? (wet ? "#1474c4" : "#e07b00") : "#ffffff";
        context.beginPath();
        context.moveTo(...(Array.isArray(a) ? a : place(a)));
        context.lineTo(...(Array.isArray(b) ? b : place(b)));
        context.stroke();
      }
    }
  }

  // Of a plane crack in 3D what the slice cuts: a short line for each facet.
  slicedFacets(crack) {
    const { frame, how } = this;
    const extents = AXES.map((axis) => { const r = rangeOf(crack.points[axis]); return r.high - r.low; });
    const plane = extents.indexOf(Math.min(...extents));
    if (plane === how.normal) return [];
    const along = plane === how.across ? how.up : how.across;
    const lines = [];
    for (let i = 0; i < crack.count; ++i) {
      if (!this.inSlice(crack, i)) continue;
      const end = (side) => {
        const x = [how.across, how.up].map((axis) => crack.points[AXES[axis]][i] + (axis === along ? side * crack.points.edge[i] / 2 : 0));
        return [frame.column(x[0]), frame.row(x[1])];
      };
      lines.push([end(-1), end(1)]);
    }
    return lines;
  }

  // Principal directions: a bar along each, as long as the stress is large; inwards (compression) and outwards in two colours.
  drawCrosses(stress) {
    const { frame, how } = this;
    const { context } = frame;
    const [a, b] = [AXES[how.across], AXES[how.up]];
    const shear = stress[a + b] || stress[b + a];
    const found = stress.at.map((i, n) => [i, principalIn(stress[a + a][n], stress[b + b][n], shear[n])])
      .filter(([i, p]) => this.nearSlice(stress, i) && Number.isFinite(p.first));
    const sizes = found.flatMap(([, p]) => [Math.abs(p.first), Math.abs(p.second)]).sort((p, q) => p - q);
    const largest = sizes.length ? sizes[Math.floor(0.97 * (sizes.length - 1))] : 0;
    if (!(largest > 0)) return 0;
    const reach = 0.46 * stress.gap * Math.min(frame.scaleX, frame.scaleY);
    for (const [i, { first, second, angle }] of found) {
      const [x, y] = this.at(stress.layer, i);
      for (const [size, turn] of [[first, angle], [second, angle + Math.PI / 2]]) {
        const long = reach * Math.min(Math.abs(size) / largest, 1.1);
        const [dx, dy] = [long * Math.cos(turn), -long * Math.sin(turn)];
        for (const [width, style] of [[2.8, "rgba(255,255,255,0.55)"], [1.3, size < 0 ? "#12202e" : "#c0152f"]]) {
          context.lineWidth = width;
          context.strokeStyle = style;
          context.beginPath();
          context.moveTo(frame.column(x) - dx, frame.row(y) - dy);
          context.lineTo(frame.column(x) + dx, frame.row(y) + dy);
          context.stroke();
        }
      }
    }
    return largest;
  }

  nearSlice(stress, i) {
    const { normal, cut } = this.how;
    return normal < 0 || Math.abs(stress.layer.points[AXES[normal]][i] - cut) <= 0.501 * stress.gap;
  }

  // Velocities of one point in each cell of a grid; the fastest is two cells long.
  drawArrows(layer) {
    if (!layer.velocity) return 0;
    const { frame, how } = this;
    const { context } = frame;
    const [u, v] = [layer.velocity[how.across], layer.velocity[how.up]];
    const speed = u.map((_, i) => (this.inSlice(layer, i) ? Math.hypot(u[i], v[i]) : NaN));
    const fastest = rangeOf(speed).high;
    if (!(fastest > 0)) return 0;
    const taken = new Set();
    context.strokeStyle = "#12202e";
    context.lineWidth = 1.2;
    context.beginPath();
    for (let i = 0; i < speed.length; ++i) {
      const [x, y] = this.at(layer, i);
      const from = [frame.column(x), frame.row(y)];
      const key = `${Math.floor(from[0] / 22)} ${Math.floor(from[1] / 22)}`;
      if (!(speed[i] > 0.01 * fastest) || taken.has(key)) continue;
      taken.add(key);
      const to = [from[0] + (44 * u[i]) / fastest, from[1] - (44 * v[i]) / fastest];
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
    return fastest;
  }

  // The point under the mouse; null: none.
  pointAt(event) {
    const [x, y] = this.frame.place(event.offsetX, event.offsetY);
    let nearest = null, least = 1;
    for (const cell of this.cells) {
      const distance = Math.max(Math.abs(cell.x - x), Math.abs(cell.y - y)) / Math.max(cell.half, 1.5 / this.frame.scaleX);
      if (distance < least) { least = distance; nearest = cell; }
    }
    return nearest;
  }
}

// In-plane principal values of a symmetric tensor, the larger first, and its direction.
function principalIn(xx, yy, xy) {
  const middle = (xx + yy) / 2, radius = Math.hypot((xx - yy) / 2, xy);
  return { first: middle + radius, second: middle - radius, angle: 0.5 * Math.atan2(2 * xy, xx - yy) };
}

// Pairs of facets that follow one another along each branch; a lone facet is paired with itself.
function crackLines(crack) {
  if (!crack.along) return Array.from({ length: crack.count }, (_, i) => [i, i]);
  const branches = new Map();
  crack.frame.paths.branch.forEach((branch, i) => branches.set(branch, [...(branches.get(branch) || []), i]));
  const lines = [...crack.frame.paths.joined];
  for (const members of branches.values()) {
    members.sort((i, j) => crack.along[i] - crack.along[j]);
    if (members.length === 1) lines.push([members[0], members[0]]);
    for (let n = 1; n < members.length; ++n) lines.push([members[n - 1], members[n]]);
  }
  return lines;
}
