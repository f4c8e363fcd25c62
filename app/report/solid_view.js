"use strict";

// A body in 3D that turns: each point a cube of its own size, cut open by a plane, with cracks as facets. WebGL 2.

const VERTEX_SHADER = `#version 300 es
in vec3 corner; in vec3 normal; in vec3 centre; in float edge; in float value;
uniform mat4 view; uniform vec3 shape; uniform vec3 cutAxis; uniform float cut; uniform float turned;
out float v; out float light;
void main() {
  bool gone = turned > 0.0 ? dot(cutAxis, centre) > cut : dot(cutAxis, centre) < cut;
  vec4 place = view * vec4(centre + edge * shape * corner, 1.0);
  gl_Position = gone ? vec4(2.0, 2.0, 2.0, 1.0) : place;
  v = value;
  light = 0.72 + 0.28 * abs(dot(normal, normalize(vec3(0.35, -0.5, 0.8))));
}`;
const FRAGMENT_SHADER = `#version 300 es
precision highp float;
in float v; in float light; out vec4 colour;
uniform sampler2D map; uniform vec3 absent;
void main() {
  vec3 shown = v < -0.5 ? absent : texture(map, vec2((clamp(v, 0.0, 1.0) * 255.0 + 0.5) / 256.0, 0.5)).rgb;
  colour = vec4(shown * light, 1.0);
}`;

function cubeTriangles() {
  const corners = [], normals = [];
  for (const axis of [0, 1, 2]) for (const side of [-1, 1]) {
    const at = (p, q) => { const c = [0, 0, 0]; c[axis] = side / 2; c[(axis + 1) % 3] = p / 2; c[(axis + 2) % 3] = q / 2; return c; };
    const normal = [0, 0, 0];
    normal[axis] = side;
    for (const [p, q] of [[-1, -1], [1, -1], [1, 1], [-1, -1], [1, 1], [-1, 1]]) { corners.push(...at(p, q)); normals.push(...normal); }
  }
  return { corners: new Float32Array(corners), normals: new Float32Array(normals) };
}

// Turns about the middle of the box, seen from far away: lengths stay comparable.
function viewMatrix({ turn, tilt, zoom }, box, aspect) {
  const middle = box.low.map((low, a) => (low + box.high[a]) / 2);
  const radius = Math.hypot(...box.low.map((low, a) => (box.high[a] - low) / 2)) || 1;
  const [c, s, d, t] = [Math.cos(turn), Math.sin(turn), Math.cos(tilt), Math.sin(tilt)];
  const rows = [[c, s, 0], [-s * t, c * t, d], [s * d, -c * d, t]];  // right, up, towards the eye
  const scale = zoom / radius;
  const sizes = [scale / Math.max(aspect, 1), scale * Math.min(aspect, 1), -0.2 * scale / zoom];
  const matrix = new Float32Array(16);
  rows.forEach((row, r) => {
    row.forEach((value, column) => { matrix[4 * column + r] = sizes[r] * value; });
    matrix[12 + r] = -sizes[r] * row.reduce((sum, value, a) => sum + value * middle[a], 0);
  });
  matrix[15] = 1;
  return matrix;
}

class SolidView {
  constructor(canvas, labels, onTurn) {
    [this.canvas, this.labels, this.onTurn] = [canvas, labels, onTurn];
    this.gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
    this.home = { turn: -0.6, tilt: 0.45, zoom: 1 };
    this.pose = { ...this.home };
    if (!this.gl) return;
    this.program = this.makeProgram();
    this.cube = this.makeCube();
    this.batches = [];
    this.listen();
  }

  get works() { return Boolean(this.gl); }

  makeProgram() {
    const { gl } = this;
    const program = gl.createProgram();
    for (const [kind, source] of [[gl.VERTEX_SHADER, VERTEX_SHADER], [gl.FRAGMENT_SHADER, FRAGMENT_SHADER]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    return program;
  }

  makeCube() {
    const { corners, normals } = cubeTriangles();
    return { corner: this.buffer(corners), normal: this.buffer(normals), count: corners.length / 3 };
  }

  buffer(data) {
    const { gl } = this;
    const buffer = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
    return buffer;
  }

  texture(colours) {
    const { gl } = this;
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    const bytes = Uint8Array.from(colours.flatMap((hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16))));
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB, 256, 1, 0, gl.RGB, gl.UNSIGNED_BYTE, bytes);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
    return texture;
  }

  batch(layer, values, range, texture, shape, magnify, cutOpen) {
    const centre = new Float32Array(3 * layer.count), shown = new Float32Array(layer.count);
    for (let i = 0; i < layer.count; ++i) {
      AXES.forEach((axis, a) => {
        const u = layer.displacement && magnify ? magnify * layer.displacement[a][i] : 0;
        centre[3 * i + a] = layer.points[axis][i] + u;
      });
      const share = range.high > range.low ? (values[i] - range.low) / (range.high - range.low) : 0.5;
      shown[i] = Number.isFinite(values[i]) ? Math.min(Math.max(share, 0), 1) : -1;
    }
    return { count: layer.count, centre: this.buffer(centre), edge: this.buffer(layer.points.edge), value: this.buffer(shown),
             texture, shape, cutOpen };
  }

  // As FieldMap.draw; `how.crackColours` and `how.crackRange` are those of openings.
  show(scene, how) {
    this.how = how;
    const { gl } = this;
    for (const old of this.batches) for (const name of ["centre", "edge", "value"]) gl.deleteBuffer(old[name]);
    for (const old of new Set(this.batches.map((batch) => batch.texture))) gl.deleteTexture(old);
    const texture = this.texture(how.colours), ofCracks = this.texture(how.crackColours);
    this.batches = scene.layers.map((layer) => this.batch(layer, layer.values, how.range, texture, [1, 1, 1], how.magnify, true));
    for (const crack of how.cracks ? scene.cracks : []) {
      if (!crack.opening) continue;
      this.batches.push(this.batch(crack, crack.opening, how.crackRange, ofCracks, this.flatShape(crack), 0, false));
    }
    this.draw();
  }

  // Facets of a plane crack are plates; others stay small cubes.
  flatShape(crack) {
    const extents = AXES.map((axis) => { const r = rangeOf(crack.points[axis]); return r.high - r.low; });
    const least = Math.min(...extents);
    return extents.map((extent) => (extent === least && least < 1e-6 * Math.max(...extents, 1e-300) ? 0.12 : 1));
  }

  draw() {
    const { gl, canvas, how } = this;
    const ratio = devicePixelRatio || 1;
    canvas.width = Math.round(canvas.clientWidth * ratio);
    canvas.height = Math.round(canvas.clientHeight * ratio);
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.useProgram(this.program);
    const matrix = viewMatrix(this.pose, how.box, canvas.width / canvas.height);
    const uniform = (name) => gl.getUniformLocation(this.program, name);
    gl.uniformMatrix4fv(uniform("view"), false, matrix);
    gl.uniform3f(uniform("absent"), 0.6, 0.65, 0.7);
    for (const batch of this.batches) this.drawBatch(batch, uniform);
    this.drawLabels(matrix);
  }

  drawBatch(batch, uniform) {
    const { gl, how } = this;
    const attribute = (name, buffer, size, each) => {
      const at = gl.getAttribLocation(this.program, name);
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.enableVertexAttribArray(at);
      gl.vertexAttribPointer(at, size, gl.FLOAT, false, 0, 0);
      gl.vertexAttribDivisor(at, each);
    };
    attribute("corner", this.cube.corner, 3, 0);
    attribute("normal", this.cube.normal, 3, 0);
    attribute("centre", batch.centre, 3, 1);
    attribute("edge", batch.edge, 1, 1);
    attribute("value", batch.value, 1, 1);
    const axis = [0, 0, 0];
    if (how.normal >= 0) axis[how.normal] = 1;
    gl.uniform3fv(uniform("cutAxis"), axis);
    // The half is taken away that would hide the cut.
    const turned = how.normal === 1 ? -1 : 1;
    gl.uniform1f(uniform("turned"), turned);
    const whole = how.normal < 0 || !batch.cutOpen || !how.cutOpen;
    gl.uniform1f(uniform("cut"), whole ? turned * 1e30 : how.cut);
    gl.uniform3fv(uniform("shape"), batch.shape);
    gl.bindTexture(gl.TEXTURE_2D, batch.texture);
    gl.drawArraysInstanced(gl.TRIANGLES, 0, this.cube.count, batch.count);
  }

  // The edges of the box from its first corner, with names and lengths, over the picture.
  drawLabels(matrix) {
    const { labels, how } = this;
    const ratio = devicePixelRatio || 1;
    labels.width = this.canvas.width;
    labels.height = this.canvas.height;
    const context = labels.getContext("2d");
    context.scale(ratio, ratio);
    context.font = '12px system-ui, "DejaVu Sans", sans-serif';
    context.fillStyle = styleValue("--ink");
    context.strokeStyle = styleValue("--faint");
    const [width, height] = [labels.width / ratio, labels.height / ratio];
    const place = (point) => {
      const at = [0, 1].map((r) => matrix[r] * point[0] + matrix[4 + r] * point[1] + matrix[8 + r] * point[2] + matrix[12 + r]);
      return [(0.5 + 0.5 * at[0]) * width, (0.5 - 0.5 * at[1]) * height];
    };
    const { low, high } = how.box;
    AXES.forEach((name, a) => {
      const from = [low[0], low[1], low[2]], to = [...from];
      to[a] = high[a];
      const [p, q] = [place(from), place(to)];
      context.beginPath();
      context.moveTo(...p);
      context.lineTo(...q);
      context.stroke();
      const beyond = [q[0] + 0.06 * (q[0] - p[0]), q[1] + 0.06 * (q[1] - p[1])];
      const text = `${name} ${shortNumber(high[a] * how.length.factor)} ${how.length.unit}`;
      const wide = context.measureText(text).width;
      const at = [Math.min(Math.max(beyond[0] - wide / 2, 2), width - wide - 2), Math.min(Math.max(beyond[1] + 4, 12), height - 4)];
      context.lineWidth = 4;
      context.strokeStyle = styleValue("--panel");
      context.strokeText(text, ...at);
      context.fillText(text, ...at);
      context.lineWidth = 1;
      context.strokeStyle = styleValue("--faint");
    });
  }

  turnBy(turn, tilt) {
    this.pose.turn += turn;
    this.pose.tilt = Math.min(Math.max(this.pose.tilt + tilt, -1.55), 1.55);
    this.draw();
    this.onTurn?.(this.pose);
  }

  zoomBy(factor) {
    this.pose.zoom = Math.min(Math.max(this.pose.zoom * factor, 0.3), 12);
    this.draw();
    this.onTurn?.(this.pose);
  }

  listen() {
    const { canvas } = this;
    canvas.addEventListener("pointerdown", (event) => { canvas.setPointerCapture(event.pointerId); this.held = event; });
    canvas.addEventListener("pointerup", () => { this.held = null; });
    canvas.addEventListener("pointermove", (event) => {
      if (!this.held) return;
      this.turnBy((event.clientX - this.held.clientX) / 120, (event.clientY - this.held.clientY) / 120);
      this.held = event;
    });
    canvas.addEventListener("wheel", (event) => {
      if (document.activeElement !== canvas) return;  // the page scrolls on until the view is clicked
      event.preventDefault();
      this.zoomBy(Math.exp(-event.deltaY / 500));
    }, { passive: false });
    canvas.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: [-0.15, 0], ArrowRight: [0.15, 0], ArrowUp: [0, 0.15], ArrowDown: [0, -0.15] }[event.key];
      const factor = { "+": 1.2, "=": 1.2, "-": 1 / 1.2 }[event.key];
      if (step) this.turnBy(...step);
      else if (factor) this.zoomBy(factor);
      else if (event.key === "Home") { this.pose = { ...this.home }; this.turnBy(0, 0); }
      else return;
      event.preventDefault();
    });
  }
}
