"use strict";

// Asks the server what has come of the run, and shows it. The token is behind the # of the address, which no request carries.

const { palettes } = JSON.parse(document.getElementById("run-data").textContent);
const byId = (name) => document.getElementById(name);
const token = location.hash.slice(1);

async function ask(path, method = "GET") {
  return fetch(path, { method, headers: { [document.body.dataset.tokenHeader]: token }, cache: "no-store" });
}

async function askJson(path) {
  const answer = await ask(path);
  const data = await answer.json();
  if (!answer.ok) throw Object.assign(new Error(data.error), { refused: true });
  return data;
}

async function askChunk(key) {
  const answer = await ask(`/chunk/${key}`);
  if (!answer.ok) throw new Error(`chunk ${key}: ${answer.status}`);
  return new Uint8Array(await answer.arrayBuffer());
}

const STATES = { running: "running", waiting: "has not begun", gone: "was killed", done: "done", failed: "failed", stopped: "stopped" };

class WatchPage {
  constructor() {
    this.versions = { fields: -1, charts: -1 };
    this.charts = [];
    for (const button of document.querySelectorAll("[data-wish]")) button.addEventListener("click", () => this.wish(button.dataset.wish));
    let width = innerWidth;
    addEventListener("resize", () => { if (innerWidth !== width) { width = innerWidth; this.charts.forEach((chart) => chart.draw()); } });
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.charts.forEach((chart) => chart.draw()));
    this.look();
  }

  async look() {
    try {
      await this.take(await askJson("/state"));
    } catch (error) {
      this.lost(error);
      if (error.refused || !this.goesOn) return;  // nothing more will come
    }
    setTimeout(() => this.look(), document.hidden ? 4000 : 1000);
  }

  async take(state) {
    this.state = state;
    document.title = `${state.part === null ? "" : `${Math.floor(100 * state.part)} % `}${state.title} · perifrac`;
    byId("title").textContent = state.title;
    byId("outcome").textContent = STATES[state.outcome] || state.outcome;
    byId("outcome").dataset.outcome = state.outcome;
    if (byId("effects").innerHTML !== state.effects) byId("effects").innerHTML = state.effects;
    this.showProgress(state);
    for (const name of ["failure", "warnings", "ledger"]) {
      byId(name).hidden = !state[name];
      const place = byId(name).querySelector("div");
      if (this[name] !== state[name]) place.innerHTML = this[name] = state[name];
    }
    for (const button of document.querySelectorAll("[data-wish]")) {
      button.disabled = !state.may;
      button.title = state.why_not;
    }
    byId("place").textContent = state.report ? `Results, with a report (report.html), are in ${state.folder}` : `Results are in ${state.folder}`;
    if (state.charts_version !== this.versions.charts) await this.takeCharts();
    if (state.fields_version !== this.versions.fields) await this.takeFields();
  }

  showProgress(state) {
    const part = state.outcome === "done" ? 1 : state.part;
    const bar = byId("progress");
    bar.hidden = part === null;
    if (part !== null) {
      bar.firstElementChild.style.width = `${100 * part}%`;
      bar.setAttribute("aria-valuenow", String(Math.floor(100 * part)));
    }
    const facts = part === null ? state.facts : [["done", `${Math.floor(100 * part)} %`], ...state.facts];
    byId("facts").replaceChildren(...facts.map(([name, value]) => {
      const holder = document.createElement("div");
      for (const [tag, text] of [["dt", name], ["dd", value]]) holder.append(Object.assign(document.createElement(tag), { textContent: text }));
      return holder;
    }));
  }

  async takeCharts() {
    const { version, charts, leading } = await askJson("/charts");
    this.versions.charts = version;
    const isShown = this.charts.length === charts.length && charts.every((chart, i) => this.charts[i].chart.title === chart.title);
    if (isShown) {
      charts.forEach((chart, i) => this.charts[i].update(chart));
    } else {
      for (const holder of [byId("leading"), byId("charts")]) holder.replaceChildren();
      this.charts = charts.map((chart, i) => {
        const holder = document.createElement("div");
        holder.className = "chart";
        byId(leading.includes(i) ? "leading" : "charts").append(holder);
        return new ChartView(holder, chart, palettes.sequential);
      });
    }
    byId("histories").hidden = charts.length <= leading.length;
    byId("fields").hidden = false;
    this.charts.forEach((chart) => chart.draw());  // now that their holders have a width
  }

  async takeFields() {
    const { version, fields } = await askJson("/fields");
    const first = this.versions.fields < 0 || !this.view;
    this.versions.fields = version;
    const root = document.querySelector("[data-fields]");
    root.hidden = !fields;
    if (!fields) return;
    byId("fields").hidden = false;
    if (first) {
      this.view = new FieldsView(root, fields, new ChunkStore(askChunk), palettes,
                                 (time) => this.charts.forEach((chart) => chart.mark(time)));
    } else {
      await this.view.update(fields);
    }
  }

  get goesOn() { return !this.state || ["running", "waiting"].includes(this.state.outcome); }

  lost(error) {
    byId("outcome").textContent = error.refused ? "not allowed" : "no more news";
    byId("answer").textContent = error.refused ? error.message
      : !this.goesOn ? "" : "The server has ended, with the run that it belonged to or by itself.";
    if (!error.refused && !this.goesOn) byId("outcome").textContent = STATES[this.state.outcome] || this.state.outcome;
    for (const button of document.querySelectorAll("[data-wish]")) button.disabled = true;
    if (!(error instanceof TypeError) && !error.refused) console.error(error);
  }

  async wish(what) {
    if (what === "stop" && !confirm("Stop the run? It writes a checkpoint first, and can be gone on from.")) return;
    const answer = await ask(`/${what}`, "POST");
    const said = await answer.json();
    const done = { stop: "It stops after this window, with a checkpoint.", checkpoint: "It writes the checkpoint after this window, and goes on." };
    byId("answer").textContent = answer.ok ? done[what] : said.error;
  }
}

new WatchPage();
