// The path in the plane: drawn from what is on the screen, with the cursor above it.

T.PathView = class {
  constructor(host, state) {
    this.host = host;
    this.state = state;
    this.base = host.querySelector('.base');
    this.top = host.querySelector('.top');
    this.tip = host.querySelector('.tip');
    this.view = {x: 0, y: 0, scale: 1};
    this.pointers = new Map();
    new ResizeObserver(() => this.resize()).observe(host);
    this.listen();
  }

  resize() {
    const {clientWidth: w, clientHeight: h} = this.host;
    if (!w || !h) return;
    const was = this.width;
    this.width = w;
    this.height = h;
    this.ratio = Math.min(2, window.devicePixelRatio || 1);
    for (const canvas of [this.base, this.top]) {
      canvas.width = Math.round(w * this.ratio);
      canvas.height = Math.round(h * this.ratio);
    }
    if (!was || !this.isMoved) this.frame();
    this.drawNow();  // a canvas of a new size is empty
  }

  fit() {
    this.frame();
    this.draw();
  }

  // The whole path into sight; on a narrow page above the legend, which would hide a part of it.
  frame() {
    let [x0, x1, y0, y1] = [Infinity, -Infinity, Infinity, -Infinity];
    for (const run of this.state.runs) {
      for (let i = 0; i < run.n; ++i) {
        if (!this.isShown(run, i)) continue;
        x0 = Math.min(x0, run.x[i]); x1 = Math.max(x1, run.x[i]);
        y0 = Math.min(y0, run.y[i]); y1 = Math.max(y1, run.y[i]);
      }
    }
    if (!(x1 >= x0)) [x0, x1, y0, y1] = [-1, 1, -1, 1];
    const margin = Math.min(46, this.width / 9);
    const foot = this.width < 560 ? this.host.querySelector('.scale').offsetHeight : 0;
    const height = this.height - foot - 2 * margin;
    this.view.scale = Math.min((this.width - 2 * margin) / Math.max(x1 - x0, 1e-2), height / Math.max(y1 - y0, 1e-2));
    this.view.x = (x0 + x1) / 2;
    this.view.y = (y0 + y1) / 2 - foot / 2 / this.view.scale;
    this.isMoved = false;
  }

  isShown(run, i) { return this.state.showRapids || run.kind[i] === T.kinds.cut; }
  sx(x) { return this.width / 2 + (x - this.view.x) * this.view.scale; }
  sy(y) { return this.height / 2 - (y - this.view.y) * this.view.scale; }

  // Directions of the motion, for what is drawn beside it.
  normals(run) {
    if (run.nx) return;
    run.nx = new Float32Array(run.n);
    run.ny = new Float32Array(run.n);
    let [nx, ny] = [0, 1];
    for (let i = 0; i < run.n; ++i) {
      const a = Math.max(0, i - 1);
      const b = Math.min(run.n - 1, i + 1);
      const dx = run.x[b] - run.x[a];
      const dy = run.y[b] - run.y[a];
      const l = Math.hypot(dx, dy);
      if (l > 1e-5) [nx, ny] = [-dy / l, dx / l];
      run.nx[i] = nx;
      run.ny[i] = ny;
    }
  }

  // Where a row is drawn [px]: the set point, or that with the contour error made larger.
  place(run, i) {
    const m = run.e && this.state.magnify ? this.state.magnify * run.e[i] * 1e-3 : 0;
    return m ? [this.sx(run.x[i] + m * run.nx[i]), this.sy(run.y[i] + m * run.ny[i])] : [this.sx(run.x[i]), this.sy(run.y[i])];
  }

  zoom(factor, px = this.width / 2, py = this.height / 2) {
    const v = this.view;
    const scale = Math.min(2e6, Math.max(1e-2, v.scale * factor));
    v.x += (px - this.width / 2) * (1 / v.scale - 1 / scale);
    v.y -= (py - this.height / 2) * (1 / v.scale - 1 / scale);
    v.scale = scale;
    this.isMoved = true;
    this.draw();
  }

  show(i) {  // brings a row into sight
    const [x, y] = this.place(this.state.runs[0], i);
    if (x > 20 && y > 20 && x < this.width - 20 && y < this.height - 20) return;
    this.view.x = this.state.runs[0].x[i];
    this.view.y = this.state.runs[0].y[i];
    this.isMoved = true;
    this.draw();
  }

  draw() {
    if (this.pending || !this.width) return;
    this.pending = true;
    requestAnimationFrame(() => { this.pending = false; this.drawNow(); });
  }

  drawNow() {
    if (this.state.runs.some((run) => run.e)) this.state.runs.forEach((run) => this.normals(run));
    const g = this.base.getContext('2d');
    g.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    g.clearRect(0, 0, this.width, this.height);
    this.drawGrid(g);
    const run = this.state.runs[0];
    if (this.state.showProgram) this.drawOutline(g, run);
    this.state.runs.slice(1).forEach((other) => this.drawRun(g, other, null));
    this.drawRun(g, run, this.state.runs.length > 1 ? null : this.state.colouring);
    this.drawMarks(g, run);
    this.drawCursor();
  }

  gridStep() {
    const raw = 90 / this.view.scale;
    const ten = 10 ** Math.floor(Math.log10(raw));
    return [1, 2, 5, 10].map((k) => k * ten).find((step) => step >= raw);
  }

  drawGrid(g) {
    const step = this.gridStep();
    const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
    g.lineWidth = 1;
    g.strokeStyle = T.css('--grid');
    g.fillStyle = T.css('--soft');
    g.font = '10px system-ui, sans-serif';
    g.textAlign = 'center';
    g.beginPath();
    const [w, h] = [this.width / 2 / this.view.scale, this.height / 2 / this.view.scale];
    const labels = [];
    for (let x = Math.ceil((this.view.x - w) / step) * step; x <= this.view.x + w; x += step) {
      const px = Math.round(this.sx(x)) + 0.5;
      g.moveTo(px, 0); g.lineTo(px, this.height);
      if (px > 84) labels.push([T.number(x, digits), px, 11, 'center']);
    }
    for (let y = Math.ceil((this.view.y - h) / step) * step; y <= this.view.y + h; y += step) {
      const py = Math.round(this.sy(y)) + 0.5;
      g.moveTo(0, py); g.lineTo(this.width, py);
      if (py > 22) labels.push([T.number(y, digits), this.width - 5, py - 3, 'right']);
    }
    g.stroke();
    for (const [text, x, y, align] of labels) { g.textAlign = align; g.fillText(text, x, y); }
    g.textAlign = 'left';
    g.fillText('X, Y in mm', 6, 11);
  }

  drawOutline(g, run) {
    const o = run.outline;
    if (!o || !o.x || !o.x.length) return;
    g.strokeStyle = T.css('--program');
    g.lineWidth = 1;
    g.globalAlpha = 0.75;
    g.beginPath();
    const lifts = new Set(o.lifts);
    let [lx, ly] = [NaN, NaN];
    for (let i = 0; i < o.x.length; ++i) {
      const x = this.sx(o.x[i]);
      const y = this.sy(o.y[i]);
      if (i === 0 || lifts.has(i)) g.moveTo(x, y);
      else if (Math.abs(x - lx) + Math.abs(y - ly) < 0.5 && !lifts.has(i + 1)) continue;
      else g.lineTo(x, y);
      [lx, ly] = [x, y];
    }
    g.stroke();
    g.globalAlpha = 1;
  }

  // A run; coloured by a quantity, or in its own colour.
  drawRun(g, run, colouring) {
    const {bins, faint, arrows} = this.segments(run, colouring);
    g.lineJoin = g.lineCap = 'round';
    const stroke = (list) => {
      g.beginPath();
      for (let k = 0; k < list.length; k += 4) {
        if (!k || list[k] !== list[k - 2] || list[k + 1] !== list[k - 1]) g.moveTo(list[k], list[k + 1]);
        g.lineTo(list[k + 2], list[k + 3]);
      }
      g.stroke();
    };
    g.lineWidth = 1;
    g.setLineDash([3, 4]);
    g.strokeStyle = T.css('--soft');
    if (this.state.showRapids) stroke(faint);
    g.setLineDash([]);
    g.lineWidth = this.state.magnify ? 1 : colouring ? 2.4 : 1.6;
    const ramp = T.ramp();
    bins.forEach((list, b) => {
      if (!list.length) return;
      g.strokeStyle = colouring ? ramp[b] : T.category(run.number);
      stroke(list);
    });
    g.fillStyle = T.css('--soft');
    for (const [x, y, a] of arrows) {
      g.save(); g.translate(x, y); g.rotate(a);
      g.beginPath(); g.moveTo(4, 0); g.lineTo(-4, 3.5); g.lineTo(-4, -3.5); g.fill();
      g.restore();
    }
  }

  segments(run, colouring) {
    const bins = Array.from({length: T.colourCount}, () => []);
    const faint = [];
    const arrows = [];
    const values = colouring && run[colouring.key];
    const top = colouring ? this.state.range[1] : 1;
    const size = colouring && colouring.size;
    let [lx, ly] = this.place(run, 0);
    let most = 0;
    let way = 0;
    const [w, h] = [this.width + 40, this.height + 40];
    for (let i = 1; i < run.n; ++i) {
      if (values) most = Math.max(most, size ? Math.abs(values[i]) : values[i]);
      const [x, y] = this.place(run, i);
      const moved = Math.abs(x - lx) + Math.abs(y - ly);
      if (moved < 0.8 && run.kind[i] === run.kind[i - 1] && i + 1 < run.n) continue;
      const outside = (x < -40 && lx < -40) || (y < -40 && ly < -40) || (x > w && lx > w) || (y > h && ly > h);
      if (!outside && moved > 0) {
        if (run.kind[i] !== T.kinds.cut) faint.push(lx, ly, x, y);
        else bins[values ? Math.min(T.colourCount - 1, Math.floor(most / top * (T.colourCount - 1e-6))) : 0].push(lx, ly, x, y);
        way += moved;
        if (way > 230 && arrows.length < 40 && moved > 0.3) {
          way = 0;
          arrows.push([x, y, Math.atan2(y - ly, x - lx)]);
        }
      }
      [lx, ly] = [x, y];
      most = 0;
    }
    return {bins, faint, arrows};
  }

  drawMarks(g, run) {
    const dot = (i, text, fill) => {
      const [x, y] = this.place(run, i);
      g.beginPath(); g.arc(x, y, text ? 8 : 4.5, 0, 7);
      g.fillStyle = fill; g.fill();
      g.lineWidth = 1.5; g.strokeStyle = T.css('--card'); g.stroke();
      if (text) {
        g.fillStyle = T.css('--card'); g.font = '600 10px system-ui, sans-serif'; g.textAlign = 'center';
        g.fillText(text, x, y + 3.5);
      }
    };
    for (const [line, name] of run.tools || []) {
      const i = run.line.indexOf(line);
      if (i >= 0) dot(i, name, T.css('--soft'));
    }
    dot(0, '', T.category(2));
    dot(run.n - 1, '', T.css('--ink'));
    [...run.worst].reverse().forEach((i, k) => dot(i, String(run.worst.length - k), T.css('--warm')));
  }

  drawCursor() {
    const g = this.top.getContext('2d');
    g.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    g.clearRect(0, 0, this.width, this.height);
    this.state.runs.forEach((run, k) => {
      const [x, y] = this.place(run, this.state.indexOf(run));
      g.beginPath(); g.arc(x, y, 7, 0, 7);
      g.lineWidth = 4; g.strokeStyle = T.css('--card'); g.stroke();
      g.lineWidth = 2; g.strokeStyle = k ? T.category(run.number) : T.css('--ink'); g.stroke();
    });
  }

  // The row that is drawn nearest to a place on the screen, and how far from it [px].
  nearest(px, py) {
    const run = this.state.runs[0];
    const x = this.view.x + (px - this.width / 2) / this.view.scale;
    const y = this.view.y - (py - this.height / 2) / this.view.scale;
    const m = run.e ? this.state.magnify * 1e-3 : 0;
    let best = -1;
    let least = Infinity;
    for (let i = 0; i < run.n; ++i) {
      if (!this.isShown(run, i)) continue;
      const d = m * (m ? run.e[i] : 0);
      const dx = run.x[i] + (d ? d * run.nx[i] : 0) - x;
      const dy = run.y[i] + (d ? d * run.ny[i] : 0) - y;
      const q = dx * dx + dy * dy;
      if (q < least) { least = q; best = i; }
    }
    return [best, Math.sqrt(least) * this.view.scale];
  }

  hover(event) {
    const [px, py] = this.at(event);
    const [i, far] = this.nearest(px, py);
    if (i < 0 || far > 28) { this.tip.classList.remove('on'); return; }
    this.state.set(i, 'path');
    this.tip.innerHTML = T.tipText(this.state.runs[0], i);
    const left = Math.min(px + 14, this.width - this.tip.offsetWidth - 6);
    this.tip.style.transform = `translate(${Math.max(4, left)}px, ${py > this.height - 90 ? py - 66 : py + 16}px)`;
    this.tip.classList.add('on');
  }

  at(event) {
    const box = this.host.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  listen() {
    const top = this.top;
    top.addEventListener('wheel', (event) => {
      event.preventDefault();
      this.zoom(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0015)), ...this.at(event));
    }, {passive: false});
    top.addEventListener('pointerdown', (event) => {
      top.setPointerCapture(event.pointerId);
      this.pointers.set(event.pointerId, this.at(event));
      this.dragged = 0;
      this.host.focus({preventScroll: true});
    });
    top.addEventListener('pointermove', (event) => {
      if (!this.pointers.has(event.pointerId)) { if (!this.pointers.size) this.hover(event); return; }
      const before = [...this.pointers.values()];
      const was = this.pointers.get(event.pointerId);
      const now = this.at(event);
      this.pointers.set(event.pointerId, now);
      this.dragged += Math.abs(now[0] - was[0]) + Math.abs(now[1] - was[1]);
      if (this.pointers.size === 1 && this.dragged > 4) this.pan(now[0] - was[0], now[1] - was[1]);
      else if (this.pointers.size === 2) this.pinch(before, [...this.pointers.values()]);
    });
    const release = (event) => {
      if (this.pointers.delete(event.pointerId) && this.dragged <= 4 && event.type === 'pointerup') this.hover(event);
    };
    top.addEventListener('pointerup', release);
    top.addEventListener('pointercancel', release);
    top.addEventListener('pointerleave', () => this.tip.classList.remove('on'));
    top.addEventListener('dblclick', () => this.fit());
  }

  pan(dx, dy) {
    this.view.x -= dx / this.view.scale;
    this.view.y += dy / this.view.scale;
    this.isMoved = true;
    this.tip.classList.remove('on');
    this.draw();
  }

  pinch(before, now) {
    const far = ([a, b]) => Math.hypot(a[0] - b[0], a[1] - b[1]);
    const mid = ([a, b]) => [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
    const [m0, m1] = [mid(before), mid(now)];
    this.pan(m1[0] - m0[0], m1[1] - m0[1]);
    if (far(before) > 0) this.zoom(far(now) / far(before), ...m1);
  }
};
