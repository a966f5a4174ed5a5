// The table in space: the plate moves under the pen as it did in the run. Plain WebGL.

T.Scene = class {
  constructor(host, state) {
    this.host = host;
    this.state = state;
    this.canvas = host.querySelector('.space');
    this.turn = -0.6;
    this.tilt = 0.75;
    this.isStale = true;
    this.listen();
  }

  start() {
    if (this.gl) return true;
    const gl = this.gl = this.canvas.getContext('webgl', {antialias: true});
    if (!gl) return false;
    const shader = (type, text) => {
      const s = gl.createShader(type);
      gl.shaderSource(s, text);
      gl.compileShader(s);
      return s;
    };
    const program = this.program = gl.createProgram();
    gl.attachShader(program, shader(gl.VERTEX_SHADER, 'attribute vec3 p; attribute vec3 c; uniform mat4 m; uniform vec3 d; uniform vec2 o; varying vec3 v; void main() { v = c; gl_Position = m * vec4(p + d, 1.0); gl_Position.xy += o * gl_Position.w; }'));
    gl.attachShader(program, shader(gl.FRAGMENT_SHADER, 'precision mediump float; varying vec3 v; void main() { gl_FragColor = vec4(v, 1.0); }'));
    gl.linkProgram(program);
    gl.useProgram(program);
    gl.enable(gl.DEPTH_TEST);
    this.place = Object.fromEntries(['m', 'd', 'o'].map((name) => [name, gl.getUniformLocation(program, name)]));
    return true;
  }

  buffer(data) {
    const b = this.gl.createBuffer();
    this.gl.bindBuffer(this.gl.ARRAY_BUFFER, b);
    this.gl.bufferData(this.gl.ARRAY_BUFFER, new Float32Array(data), this.gl.STATIC_DRAW);
    return {b, count: data.length / 6};
  }

  // Twelve triangles of a box, shaded by their side.
  box(cx, cy, cz, hx, hy, hz, colour) {
    const out = [];
    const corner = (sx, sy, sz) => [cx + sx * hx, cy + sy * hy, cz + sz * hz];
    const sides = [[2, 1, 1], [2, -1, 0.62], [1, 1, 0.74], [1, -1, 0.86], [0, 1, 0.8], [0, -1, 0.7]];
    for (const [axis, sign, light] of sides) {
      const at = (u, v) => {
        const s = [u, v];
        const p = [0, 0, 0];
        p[axis] = sign;
        p[(axis + 1) % 3] = s[0];
        p[(axis + 2) % 3] = s[1];
        return [...corner(...p), ...colour.map((a) => a * light)];
      };
      for (const [u, v] of [[-1, -1], [1, -1], [1, 1], [-1, -1], [1, 1], [-1, 1]]) out.push(...at(u, v));
    }
    return out;
  }

  build() {
    const run = this.state.runs[0];
    const limits = T.limitsOf(run);
    const reach = (limits.travel_max_mm || [150])[0];
    this.reach = reach;
    const dark = T.isDark();
    const tint = (a) => [a, a * 1.01, a * 1.04];
    this.parts = {
      base: this.buffer([...this.box(0, 0, -150, 2.1 * reach, 2.3 * reach, 40, tint(dark ? 0.26 : 0.55)),
        ...this.box(1.25 * reach, 0, -104, 9, 2.2 * reach, 8, tint(dark ? 0.5 : 0.72)), ...this.box(-1.25 * reach, 0, -104, 9, 2.2 * reach, 8, tint(dark ? 0.5 : 0.72))]),
      saddle: this.buffer([...this.box(0, 0, -78, 1.95 * reach, 0.85 * reach, 18, tint(dark ? 0.36 : 0.66)),
        ...this.box(0, 0.6 * reach, -54, 1.9 * reach, 8, 7, tint(dark ? 0.55 : 0.78)), ...this.box(0, -0.6 * reach, -54, 1.9 * reach, 8, 7, tint(dark ? 0.55 : 0.78))]),
      plate: this.buffer([...this.box(0, 0, -26, 1.25 * reach, 1.25 * reach, 20, tint(dark ? 0.44 : 0.8)),
        ...this.box(0, 0, -4, 1.15 * reach, 1.15 * reach, 2, tint(dark ? 0.86 : 0.98))]),
      pen: this.buffer([...this.box(0, 0, 34, 2.6, 2.6, 22, [0.84, 0.37, 0]), ...this.box(0, 0, 6, 0.8, 0.8, 6, tint(0.15)),
        ...this.box(0, 14, 92, 11, 24, 36, tint(dark ? 0.5 : 0.62))]),
      path: this.buffer(this.pathVertices(run)),
    };
    this.isStale = false;
  }

  pathVertices(run) {
    const colouring = this.state.colouring;
    const values = colouring && run[colouring.key];
    const stride = Math.max(1, Math.ceil(run.n / 150000));
    const rows = [];
    for (let i = 0; i < run.n; i += stride) {
      const drawn = run.kind[i] === T.kinds.cut;
      const v = values ? Math.abs(values[i]) / this.state.range[1] : 0.5;
      const c = drawn ? T.shade(v, false).map((a) => a / 255) : [0.55, 0.58, 0.62];
      rows.push([run.x[i], run.y[i], Math.max(run.height[i], 0) * (drawn ? 0 : 1) + 0.4, ...c]);
    }
    return rows.flat();
  }

  // Projection times view, as columns.
  matrix() {
    const {width: w, height: h} = this.canvas;
    const far = this.reach * 16;
    const near = this.reach * 0.2;
    const k = 1 / Math.tan(0.3);
    const dist = this.reach * 4.9 / (this.closeness || 1);
    const [ct, st, ce, se] = [Math.cos(this.turn), Math.sin(this.turn), Math.cos(this.tilt), Math.sin(this.tilt)];
    const rows = [[ct, -st, 0, 0], [st * se, ct * se, ce, 0], [-st * ce, -ct * ce, se, -dist]];
    const [r, u, b] = rows;
    const aspect = w / h;
    const m = [];
    for (let c = 0; c < 4; ++c) {
      const z = b[c];
      m.push(k / aspect * r[c], k * u[c], (far + near) / (near - far) * z + (c === 3 ? 2 * far * near / (near - far) : 0), -z);
    }
    return m;
  }

  draw() {
    if (this.canvas.hidden || !this.start()) return;
    const gl = this.gl;
    const ratio = Math.min(2, window.devicePixelRatio || 1);
    const [w, h] = [Math.round(this.host.clientWidth * ratio), Math.round(this.host.clientHeight * ratio)];
    if (this.canvas.width !== w || this.canvas.height !== h) [this.canvas.width, this.canvas.height] = [w, h];
    if (this.isStale) this.build();
    gl.viewport(0, 0, w, h);
    const ground = T.isDark() ? [0.098, 0.114, 0.129] : [1, 1, 1];
    gl.clearColor(...ground, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.uniformMatrix4fv(this.place.m, false, this.matrix());
    const run = this.state.runs[0];
    const i = this.state.index;
    const [x, y, z] = [run.x[i], run.y[i], run.height[i]];
    const solid = (part, d) => this.put(part, d, gl.TRIANGLES, [0, 0]);
    solid(this.parts.base, [0, 0, 0]);
    solid(this.parts.saddle, [0, -y, 0]);
    solid(this.parts.plate, [-x, -y, 0]);
    solid(this.parts.pen, [0, 0, Math.max(0, z) + 0.5]);
    for (const o of [[0, 0], [1.2 / w, 0], [0, 1.2 / h], [1.2 / w, 1.2 / h]]) this.put(this.parts.path, [-x, -y, 0], gl.LINE_STRIP, o);
  }

  put(part, d, mode, o) {
    const gl = this.gl;
    gl.bindBuffer(gl.ARRAY_BUFFER, part.b);
    for (const [name, at] of [['p', 0], ['c', 12]]) {
      const a = gl.getAttribLocation(this.program, name);
      gl.enableVertexAttribArray(a);
      gl.vertexAttribPointer(a, 3, gl.FLOAT, false, 24, at);
    }
    gl.uniform3fv(this.place.d, d);
    gl.uniform2fv(this.place.o, o);
    gl.drawArrays(mode, 0, part.count);
  }

  zoom(factor) {
    this.closeness = Math.min(20, Math.max(0.4, (this.closeness || 1) * factor));
    this.draw();
  }

  listen() {
    let last = null;
    this.canvas.addEventListener('pointerdown', (event) => {
      last = [event.clientX, event.clientY];
      this.canvas.setPointerCapture(event.pointerId);
    });
    this.canvas.addEventListener('pointermove', (event) => {
      if (!last) return;
      this.turn += (event.clientX - last[0]) * 0.008;
      this.tilt = Math.min(1.55, Math.max(0.1, this.tilt + (event.clientY - last[1]) * 0.006));
      last = [event.clientX, event.clientY];
      this.draw();
    });
    this.canvas.addEventListener('pointerup', () => { last = null; });
    this.canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      this.zoom(Math.exp(-event.deltaY * 0.0015));
    }, {passive: false});
  }
};
