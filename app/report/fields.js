"use strict";

// The controls of a run's fields, and what they show: map, 3D view, charts along cracks.

// Largest displacement as a share of the body, at the end of its slider.
const MOST_MOVED = 0.12;

class FieldsView {
  // `root` holds what fields.html has. `onTime(time)` is called as the time shown changes.
  constructor(root, data, store, palettes, onTime) {
    Object.assign(this, { root, palettes, onTime, data });
    root.view = this;  // for whoever looks into the page, as tests do
    this.frames = new FieldFrames(data, store);
    this.map = new FieldMap(this.part("map"));
    this.along = new AlongCharts(this.part("along"), this.frames, palettes.sequential);
    this.is3d = data.dimension === 3;
    this.show3d(this.is3d);
    this.fill("view", data.views.map((view) => view.name.replaceAll("_", " ")));
    this.fill("normal", AXES.map((axis) => axis));
    for (const name of ["view", "normal"]) this.part(name).addEventListener("change", () => this.choose(name));
    for (const name of ["field", "rescale", "arrows", "crosses", "cracks", "open"]) this.part(name).addEventListener("change", () => this.show());
    this.part("field").addEventListener("change", () => this.peer?.follow(this.field.label));
    for (const name of ["time", "magnify", "cut"]) this.part(name).addEventListener("input", () => this.show());
    this.part("play").addEventListener("click", () => this.play(!this.timer));
    this.part("map").addEventListener("pointermove", (event) => this.read(event));
    this.part("map").addEventListener("pointerleave", () => this.describe());
    new ResizeObserver(() => this.onResize()).observe(root);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { this.show(); this.along.redraw(); });
    this.setTimes(true);
    this.choose("view");
  }

  part(name) { return this.root.querySelector(`[data-part="${name}"]`); }
  reveal(name, shown) { const holder = this.root.querySelector(`[data-for="${name}"]`); if (holder) holder.hidden = !shown; }
  checked(name) { return this.part(name).checked; }

  show3d(wanted) {
    this.solid = wanted ? new SolidView(this.part("solid"), this.part("labels")) : null;
    if (this.solid && !this.solid.works) { this.solid = null; this.note3d = "The 3D view needs WebGL 2, which is off here."; }
    this.reveal("solid", Boolean(this.solid));
    this.root.classList.toggle("has-solid", Boolean(this.solid));
  }

  fill(name, labels) {
    const select = this.part(name), chosen = select.selectedOptions[0]?.text;
    select.replaceChildren(...labels.map((label, i) => new Option(label, String(i))));
    if (labels.includes(chosen)) select.value = String(labels.indexOf(chosen));
    if (name === "view") this.reveal("view", labels.length > 1);
  }

  // The last time unless another was chosen, as of a run that goes on.
  setTimes(toEnd) {
    const time = this.part("time");
    const wasLast = toEnd || time.value === time.max;
    time.max = String(this.data.times.length - 1);
    if (wasLast) time.value = time.max;
  }

  // More of the same run.
  update(data) {
    for (const view of data.views) view.box = undefined;
    this.data = this.frames.data = data;
    this.frames.sets = new Map(data.sets.map((set) => [set.name, set]));
    this.fill("view", data.views.map((view) => view.name.replaceAll("_", " ")));
    this.setTimes(false);
    this.choose("view");
  }

  get view() { return this.data.views[Number(this.part("view").value)]; }
  get field() { return this.view.fields[Number(this.part("field").value)]; }
  get place() { return Math.min(Number(this.part("time").value), this.data.times.length - 1); }
  get label() { return this.data.times[this.place].label; }
  get viewSets() { return this.view.sets.map((name) => this.frames.sets.get(name)); }

  async choose(what) {
    if (what === "view") {
      this.fill("field", this.view.fields.map((field) => field.label));
      this.box = await this.frames.box(this.view);
      this.flat = this.frames.flatAxis(this.view);
      if (!this.normalChosen) {
        this.part("normal").value = String(this.naturalNormal());
        this.part("cut").value = String(await this.naturalCut());
      }
      const sets = this.viewSets;
      this.reveal("arrows", sets.some((set) => set.velocity.length));
      this.reveal("crosses", sets.some((set) => set.stress));
      this.reveal("magnify", sets.some((set) => set.displacement.length));
      this.reveal("cracks", this.data.sets.some((set) => set.kind === "crack" && !this.view.sets.includes(set.name)));
      this.reveal("normal", this.is3d && this.flat < 0);
    } else {
      this.normalChosen = true;
      this.part("cut").value = "50";
    }
    await this.show();
  }

  // Across the shortest edge; y where edges are alike, so that what falls shows. A plane crack is looked at from its side.
  naturalNormal() {
    if (!this.is3d) return 0;
    const edges = this.box.high.map((high, a) => high - this.box.low[a]);
    const least = Math.min(...edges);
    return edges[1] <= 1.001 * least ? 1 : edges.indexOf(least);
  }

  // Through the middle of the cracks where there are any, else through that of the body: a share of 100.
  async naturalCut() {
    const normal = Number(this.part("normal").value);
    const crack = this.data.sets.find((set) => set.kind === "crack" && set.frames.at(-1));
    if (!this.is3d || !crack || this.view.sets.includes(crack.name)) return 50;
    const along = this.frames.pointsFrame(crack, crack.frames.length - 1).points[AXES[normal]];
    const middle = along.low + 0.5 * along.step * along.top;
    return Math.round((100 * (middle - this.box.low[normal])) / (this.box.high[normal] - this.box.low[normal]));
  }

  // What is drawn: axes, slice, colours and switches, as FieldMap and SolidView want them.
  how(scene) {
    const { field, box } = this;
    const chosen = Number(this.part("normal").value);
    const normal = this.is3d ? (this.flat >= 0 ? this.flat : chosen) : -1;
    const [across, up] = [0, 1, 2].filter((axis) => axis !== (normal < 0 ? 2 : normal));
    const share = (Number(this.part("cut").value) + 0.01) / 100.02;
    const cut = normal >= 0 ? this.onLayer(scene, normal, box.low[normal] + share * (box.high[normal] - box.low[normal])) : 0;
    const ofBoth = [field, this.peer?.view.fields.find((one) => one.name === field.name)].filter(Boolean);  // on one scale
    let range = { low: Math.min(...ofBoth.map((one) => one.shown[0])), high: Math.max(...ofBoth.map((one) => one.shown[1])) };
    if (this.checked("rescale")) range = rangeOf(...scene.layers.map((layer) => layer.values));
    const signed = /stress|displacement|velocity/.test(field.name);
    const both = signed && range.low < 0 && range.high > 0 && Math.min(-range.low, range.high) > 0.1 * Math.max(-range.low, range.high);
    if (both) { const end = Math.max(-range.low, range.high); range = { low: -end, high: end }; }
    const openings = this.data.views.flatMap((view) => view.fields).find((one) => one.name.includes("opening"));
    return {
      box, across, up, normal: this.flat >= 0 ? -1 : normal, cut, range, magnify: this.magnification(),
      colours: both ? this.palettes.diverging : this.palettes.sequential, crackColours: this.palettes.crack,
      crackRange: openings ? { low: 0, high: openings.high } : { low: 0, high: 1 },
      crosses: this.checked("crosses"), cracks: this.checked("cracks"), arrows: this.checked("arrows"), cutOpen: this.checked("open"),
      names: [AXES[across], AXES[up]], length: this.data.length, tallest: Math.min(560, 0.7 * innerHeight),
    };
  }

  // Where there is a layer of points near a cut, the cut goes through it.
  onLayer(scene, normal, cut) {
    let nearest = cut, least = Infinity;
    for (const layer of scene.layers) {
      for (const along of layer.points[AXES[normal]]) if (Math.abs(along - cut) < least) { least = Math.abs(along - cut); nearest = along; }
    }
    return nearest;
  }

  magnification() {
    const step = Number(this.part("magnify").value);
    if (!step) return 0;
    const fields = this.data.views.flatMap((view) => view.fields).filter((field) => field.name.includes("displacement"));
    const largest = Math.max(...fields.map((field) => Math.max(Math.abs(field.low), Math.abs(field.high))), 0);
    const size = Math.max(...this.box.high.map((high, a) => high - this.box.low[a]));
    return largest > 0 ? (MOST_MOVED * size * step) / 40 / largest : 0;
  }

  // `led`: by another run's time, which is not to be led back.
  async show(led = false) {
    const wanted = (this.wanted = (this.wanted || 0) + 1);
    if (!this.field || !this.box) return;
    const { place, view, field } = this;
    const scene = await this.frames.at(place, view, field);
    if (wanted !== this.wanted) return;  // another frame was asked for meanwhile
    this.scene = scene;
    this.draw();
    this.along.show(scene.cracks);
    if (!led) this.onTime?.(this.data.times[place].time, this);
    this.root.dataset.shown = String(wanted);
  }

  draw() {
    const how = (this.drawn = this.how(this.scene));
    this.told = this.map.draw(this.scene, how);
    if (this.solid) this.solid.show(this.scene, how);
    this.part("bar").style.background = `linear-gradient(to top, ${how.colours.filter((_, i) => i % 15 === 0).join(",")})`;
    const past = (mark, is) => (is ? `${mark} ` : "");
    this.part("high").textContent = past("≥", this.field.high > 1.0001 * how.range.high) + this.shown(how.range.high);
    this.part("low").textContent = past("≤", this.field.low < how.range.low - 1e-4 * Math.abs(how.range.low)) + this.shown(how.range.low);
    this.part("now").textContent = `t = ${this.label}`;
    this.part("time").setAttribute("aria-valuetext", this.label);
    this.part("magnified").textContent = how.magnify ? `× ${shortNumber(Number(how.magnify.toPrecision(2)))}` : "off";
    if (how.normal >= 0) this.part("cut-now").textContent = `${AXES[how.normal]} = ${this.long(how.cut)}`;
    this.describe();
    this.explain(how);
  }

  onResize() {
    const width = this.root.clientWidth;
    if (width === this.width || !this.scene) return;
    this.width = width;
    this.draw();
    this.along.redraw();
  }

  shown(value) { return `${shortNumber(value * this.field.factor)} ${this.field.unit}`.trim(); }
  long(value) { return `${shortNumber(value * this.data.length.factor)} ${this.data.length.unit}`; }

  describe() {
    if (!this.drawn) return;
    const { low, high } = rangeOf(...this.scene.layers.map((layer) => layer.values));
    const text = `${this.field.label} at t = ${this.label}: from ${this.shown(low)} to ${this.shown(high)}.`;
    this.part("readout").textContent = text;
    this.part("map").setAttribute("aria-label", text);
  }

  // What lines, bars and arrows mean.
  explain(how) {
    const parts = [];
    const stress = this.viewSets.find((set) => set.stress);
    if (how.crosses && this.told.stress > 0) {
      parts.push(`Crosses: principal ${stress.stress}, dark compression, red tension; a whole bar is ${pressureText(this.told.stress)}.`);
    }
    if (how.cracks && this.scene.cracks.length) {
      parts.push(this.is3d ? "Facets of cracks by their opening, dark to bright." : "Cracks: blue where wet, orange where dry.");
    }
    if (how.arrows && this.told.fastest > 0) parts.push(`Longest arrow: ${shortNumber(this.told.fastest)} m/s.`);
    if (this.solid) parts.push("Drag to turn; after a click the wheel zooms.");
    this.part("key").textContent = parts.join(" ");
    this.part("note").textContent = [this.data.note, ...this.viewSets.map((set) => set.note), this.note3d].filter(Boolean).join(". ");
  }

  read(event) {
    const cell = this.drawn && this.map.pointAt(event);
    if (!cell) return this.describe();
    const { layer, i } = cell;
    const where = this.frames.axes.map((axis) => `${axis} = ${this.long(layer.points[axis][i])}`).join(", ");
    const value = layer.values[i];
    this.part("readout").textContent = `${where}: ${this.field.label} ${Number.isFinite(value) ? this.shown(Number(value.toPrecision(3))) : "is not there"}`;
  }

  play(on) {
    clearInterval(this.timer);
    this.timer = on ? setInterval(() => this.step(), 350) : null;
    this.part("play").textContent = on ? "pause" : "play";
    this.part("play").setAttribute("aria-pressed", String(on));
  }

  step() { this.goTo((this.place + 1) % this.data.times.length); }

  goTo(place, led = false) {
    this.part("time").value = String(place);
    return this.show(led);
  }

  // Shows beside another run what that shows: the same field, on the same scale.
  follow(label) {
    const place = this.view.fields.findIndex((field) => field.label === label);
    if (place < 0) return;
    this.part("field").value = String(place);
    this.show(true);
  }

  // The frame nearest to a time [s], as another run shows it.
  goToTime(time) {
    const off = this.data.times.map((one) => Math.abs(one.time - time));
    const place = off.indexOf(Math.min(...off));
    if (place !== this.place) this.goTo(place, true);
  }
}

function pressureText(value) {
  const power = [[1e9, "GPa"], [1e6, "MPa"], [1e3, "kPa"]].find(([size]) => value >= size) || [1, "Pa"];
  return `${shortNumber(Number((value / power[0]).toPrecision(2)))} ${power[1]}`;
}
