"use strict";

// What of a run is to be drawn at a time: points, values, cracks, directions of stress.

const AXES = ["x", "y", "z"];

class FieldFrames {
  constructor(data, store) {
    this.data = data;
    this.store = store;
    this.sets = new Map(data.sets.map((set) => [set.name, set]));
    this.axes = AXES.slice(0, data.dimension);
  }

  // Frames carry points only where they moved: look back for the last that did.
  pointsFrame(set, place) {
    while (place > 0 && !(set.frames[place] && set.frames[place].points)) --place;
    return set.frames[place];
  }

  async named(described) {
    const names = Object.keys(described);
    const values = await Promise.all(names.map((name) => this.store.values(described[name])));
    return Object.fromEntries(names.map((name, i) => [name, values[i]]));
  }

  // One component, or the size of a vector of several; NaN where the set has none.
  async values(set, place, parts, count) {
    const frame = set.frames[place];
    if (!parts || !frame || !parts.every((part) => part in frame.values)) return new Float32Array(count).fill(NaN);
    const arrays = await Promise.all(parts.map((part) => this.store.values(frame.values[part])));
    if (arrays.length === 1) return arrays[0];
    return arrays[0].map((_, i) => Math.hypot(...arrays.map((array) => array[i])));
  }

  async vectors(set, place, parts) {
    const frame = set.frames[place];
    if (!parts.length || !frame || !parts.every((part) => part in frame.values)) return null;
    return Promise.all(parts.map((part) => this.store.values(frame.values[part])));
  }

  async layer(name, place, parts) {
    const set = this.sets.get(name);
    if (!set.frames[place]) return null;
    const frame = this.pointsFrame(set, place);
    const points = await this.named(frame.points);
    const count = points.x.length;
    const [values, displacement, velocity] = await Promise.all([
      this.values(set, place, parts, count),
      this.vectors(set, place, set.displacement),
      this.vectors(set, place, set.velocity)]);
    return { name, set, frame, points, count, values, displacement, velocity };
  }

  async crack(set, place) {
    const layer = await this.layer(set.name, place, null);
    if (!layer) return null;
    const known = Object.keys(set.frames[place].values);
    const find = (...words) => known.find((name) => words.some((word) => name.includes(word)));
    const named = { opening: find("crack_opening", "opening", "aperture"), pressure: find("pressure"), wet: find("wetted") };
    for (const [what, name] of Object.entries(named)) {
      layer[what] = name ? await this.store.values(set.frames[place].values[name]) : null;
      layer[`${what}Name`] = name;
    }
    if (layer.frame.paths) layer.along = await this.store.values(layer.frame.paths.along);
    return layer;
  }

  async stress(layer, place) {
    const described = layer.set.frames[place].stress;
    if (!described || !layer.frame.crosses) return null;
    return { at: layer.frame.crosses, gap: layer.frame.crossGap, ...(await this.named(described)) };
  }

  async at(place, view, field) {
    const layers = (await Promise.all(view.sets.map((name) => this.layer(name, place, field.of[name])))).filter(Boolean);
    const cracks = this.data.sets.filter((set) => set.kind === "crack" && !view.sets.includes(set.name));
    return {
      layers,
      cracks: (await Promise.all(cracks.map((set) => this.crack(set, place)))).filter(Boolean),
      stresses: (await Promise.all(layers.map(async (layer) => {
        const stress = await this.stress(layer, place);
        return stress && { layer, ...stress };
      }))).filter(Boolean),
    };
  }

  // The box that all points of a view ever lie in; undeformed, at the frames that say where points are.
  async box(view) {
    view.box ??= this.findBox(view);
    return view.box;
  }

  async findBox(view) {
    const box = { low: [Infinity, Infinity, Infinity], high: [-Infinity, -Infinity, -Infinity] };
    for (const name of view.sets) {
      for (const frame of this.sets.get(name).frames) {
        if (!frame || !frame.points) continue;
        const edge = frame.points.edge;
        const half = 0.5 * (edge.low + edge.step * edge.top);
        this.axes.forEach((axis, a) => {
          const along = frame.points[axis];
          if (!along.count) return;
          box.low[a] = Math.min(box.low[a], along.low - half);
          box.high[a] = Math.max(box.high[a], along.low + along.step * along.top + half);
        });
      }
    }
    for (let a = 0; a < 3; ++a) if (box.low[a] > box.high[a]) { box.low[a] = 0; box.high[a] = a < this.axes.length ? 1 : 0; }
    return box;
  }

  // The axis across which all points of a view lie in one plane, as those of a plane crack in 3D; -1: none.
  flatAxis(view) {
    if (this.axes.length < 3) return -1;
    return this.axes.findIndex((axis) => view.sets.every((name) => this.sets.get(name).frames.every(
      (frame) => !frame || !frame.points || frame.points[axis].step * frame.points[axis].top <= 1e-9 * Math.abs(frame.points.edge.low))));
  }
}

function rangeOf(...arrays) {
  let low = Infinity, high = -Infinity;
  for (const values of arrays) for (const v of values) if (Number.isFinite(v)) { low = Math.min(low, v); high = Math.max(high, v); }
  return low <= high ? { low, high } : { low: 0, high: 0 };
}
