// Curves over time or path, all with one cursor and one zoom. Of many rows the smallest and largest of each
// few pixels are drawn, so that no peak is lost.

T.Curves = class {
  constructor(host, state) {
    this.host = host;
    this.state = state;
    this.charts = [];
    this.shown = new Set(['feed', 'error', 'track', 'jerk']);
    this.isOverPath = state.runs.length > 1;
    this.range = null;
    new ResizeObserver(() => this.resize()).observe(host);
  }

  abscissa(run) { return this.isOverPath ? run.s : run.t; }
  available() {
    return T.quantities.filter((q) => q.series.some(([key]) => this.state.runs[0][key]) && (q.key !== 'height' || this.state.runs[0].hasHeight));
  }

  toggle(key) {
    if (!this.shown.delete(key)) this.shown.add(key);
    this.build();
  }

  build() {
    this.charts.forEach((chart) => chart.plot.destroy());
    this.host.textContent = '';
    this.x = this.abscissa(this.state.runs[0]);
    const list = this.available().filter((q) => this.shown.has(q.key));
    this.charts = list.map((q, k) => this.chart(q, k === list.length - 1));
    this.zoomTo(this.range);
  }

  // The runs have more rows than before.
  update() {
    this.x = this.abscissa(this.state.runs[0]);
    for (const chart of this.charts) chart.lines = this.lines(chart.q);
    this.zoomTo(this.range);
  }

  // Lines of a chart: those of a run, or one of each run.
  lines(q) {
    const runs = this.state.runs;
    const first = runs[0];
    if (runs.length === 1) {
      const strong = T.css('--ink');
      let category = 0;
      return q.series.filter(([key]) => first[key]).map(([key, name, style]) => ({
        name, values: first[key], width: style === 'strong' ? 1.6 : 1.1,
        colour: style === 'thin' ? T.category(1) : style === 'strong' ? strong : T.category([0, 2, 3, 1][category++ % 4]) + (style === 'faint' ? '99' : '')}));
    }
    const series = q.series.slice(0, 2).filter(([, , style]) => style !== 'thin');
    return series.flatMap(([key, name, style], k, all) => runs.filter((run) => run[key]).map((run) => {
      let values = run === first ? first[key] : T.resample(this.abscissa(run), run[key], this.x);
      if (this.state.differences) {
        if (run === first) return null;
        values = values.map((v, i) => v - first[key][i]);
      }
      return {name: all.length > 1 ? `${run.name}, ${name}` : run.name, values, width: style === 'strong' ? 2 : 1.1,
        colour: T.category(run.number) + (style === 'faint' ? '66' : ''), dash: k && !style ? [5, 3] : undefined};
    }).filter(Boolean));
  }

  bounds(q) {
    const limit = q.bound && T.limitsOf(this.state.runs[0])[q.bound];
    return limit && !this.state.differences ? [limit, -limit] : [];
  }

  chart(q, isLast) {
    const lines = this.lines(q);
    const box = document.createElement('div');
    box.className = 'plot';
    box.dataset.key = q.key;
    box.innerHTML = `<div class="name"><b>${q.name}</b><span>${q.unit}</span>${lines.map((line) =>
      `<span><i style="border-color:${line.colour}"></i>${T.escape(line.name)} <output>–</output></span>`).join('')}</div>`;
    this.host.append(box);
    const axis = {stroke: T.css('--soft'), grid: {stroke: T.css('--grid'), width: 1}, ticks: {stroke: T.css('--grid'), width: 1, size: 4}, font: '11px system-ui, sans-serif'};
    const bounds = this.bounds(q);
    const plot = new uPlot({
      width: this.host.clientWidth, height: this.height(isLast), padding: [6, 8, 0, 0],
      scales: {x: {time: false}, y: {range: (u, min, max) => T.yRange(min, max, bounds)}},
      legend: {show: false},
      cursor: {y: false, drag: {x: true, y: false, setScale: false}, points: {show: false}},
      axes: [
        {...axis, show: true, size: isLast ? 34 : 8, values: isLast ? undefined : () => [], label: isLast ? (this.isOverPath ? 'path, mm' : 'time, s') : undefined, labelSize: 14, labelFont: '11px system-ui, sans-serif', gap: 2},
        {...axis, size: 58, gap: 4, values: (u, splits) => T.axisTexts(splits)},
      ],
      series: [{}, ...lines.map((line) => ({stroke: line.colour, width: line.width, dash: line.dash, points: {show: false}}))],
      hooks: {
        draw: [(u) => this.drawBounds(u, bounds)],
        setCursor: [(u) => this.moved(u)],
        setSelect: [(u) => {
          if (u.select.width > 3) this.zoomTo([u.posToVal(u.select.left, 'x'), u.posToVal(u.select.left + u.select.width, 'x')]);
          u.setSelect({left: 0, top: 0, width: 0, height: 0}, false);
        }],
      },
    }, [[0, 1], ...lines.map(() => [0, 0])], box);
    plot.over.addEventListener('dblclick', () => this.zoomTo(null));
    return {q, lines, plot, box, isLast, outputs: [...box.querySelectorAll('output')]};
  }

  height(isLast) { return (this.host.clientWidth < 500 ? 120 : 138) + (isLast ? 32 : 0); }

  drawBounds(u, bounds) {
    const g = u.ctx;
    g.save();
    g.strokeStyle = T.category(1);
    g.lineWidth = devicePixelRatio;
    g.setLineDash([6 * devicePixelRatio, 4 * devicePixelRatio]);
    for (const limit of bounds) {
      const y = Math.round(u.valToPos(limit, 'y', true)) + 0.5;
      if (y < u.bbox.top || y > u.bbox.top + u.bbox.height) continue;
      g.beginPath(); g.moveTo(u.bbox.left, y); g.lineTo(u.bbox.left + u.bbox.width, y); g.stroke();
    }
    g.restore();
  }

  zoomTo(range) {
    const x = this.x;
    const all = [x[0], Math.max(x[x.length - 1], x[0] + 1e-9)];
    this.range = range && range[1] > range[0] ? [Math.max(all[0], range[0]), Math.min(all[1], range[1])] : null;
    const [a, b] = this.range || all;
    const from = Math.max(0, T.indexAt(x, a) - 1);
    const to = Math.min(x.length, T.indexAt(x, b) + 2);
    for (const chart of this.charts) {
      chart.plot.batch(() => {
        chart.plot.setData(T.thinned(x, chart.lines.map((line) => line.values), from, to, Math.max(300, this.host.clientWidth)), false);
        chart.plot.setScale('x', {min: a, max: b});
      });
    }
    this.showCursor();
  }

  moved(u) {
    if (this.isShowing || u.cursor.left < 0) return;
    this.state.set(T.nearestIndex(this.x, u.posToVal(u.cursor.left, 'x')), 'curves');
  }

  showCursor() {
    this.isShowing = true;
    const i = this.state.index;
    for (const {plot, lines, outputs, q} of this.charts) {
      plot.setCursor({left: plot.valToPos(this.x[i], 'x'), top: 10}, false);
      lines.forEach((line, k) => { outputs[k].textContent = T.number(line.values[i], q.digits); });
    }
    this.isShowing = false;
  }

  resize() {
    const width = this.host.clientWidth;
    if (!width || width === this.width) return;
    this.width = width;
    this.charts.forEach(({plot, isLast}) => plot.setSize({width, height: this.height(isLast)}));
    this.zoomTo(this.range);
  }
};

// Rows from, ..., to - 1, or the extremes of each of some buckets of them.
T.thinned = (x, columns, from, to, buckets) => {
  const n = to - from;
  if (n <= 4 * buckets) return [x, ...columns].map((v) => v.subarray(from, to));
  const size = n / buckets;
  const out = [new Float64Array(2 * buckets), ...columns.map(() => new Float32Array(2 * buckets))];
  for (let b = 0; b < buckets; ++b) {
    const p = from + Math.floor(b * size);
    const q = Math.min(to, from + Math.floor((b + 1) * size));
    out[0][2 * b] = x[p];
    out[0][2 * b + 1] = x[(p + q) >> 1];
    columns.forEach((v, k) => {
      let [lo, hi, at, bt] = [Infinity, -Infinity, 0, 0];
      for (let i = p; i < q; ++i) {
        if (v[i] < lo) { lo = v[i]; at = i; }
        if (v[i] > hi) { hi = v[i]; bt = i; }
      }
      out[k + 1][2 * b] = at < bt ? lo : hi;
      out[k + 1][2 * b + 1] = at < bt ? hi : lo;
    });
  }
  return out;
};

T.yRange = (min, max, bounds) => {
  if (min === null || min === undefined || !Number.isFinite(min)) return [0, 1];
  for (const limit of bounds) {
    if (limit > 0 && max > 0.25 * limit) max = Math.max(max, limit);
    if (limit < 0 && min < 0.25 * limit) min = Math.min(min, limit);
  }
  const pad = 0.07 * (max - min) || 0.5 * Math.abs(max) || 1;
  return [min === 0 ? 0 : min - pad, max + pad];
};

T.axisTexts = (splits) => {
  const step = splits.length > 1 ? splits[1] - splits[0] : 1;
  const digits = Math.max(0, Math.min(6, -Math.floor(Math.log10(step) + 1e-9)));
  return splits.map((v) => T.number(v, digits));
};
