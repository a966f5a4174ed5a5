'use strict';
// Numbers of the page: how they are unpacked, and what follows from them.
const T = {};

T.bytesOf = (text) => {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const raw = atob(text);
  const bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) bytes[i] = raw.charCodeAt(i);
  return bytes;
};

T.inflate = async (text) => {
  if (typeof DecompressionStream === 'undefined') {
    throw new Error('This browser cannot unpack the data of this page; one of 2023 or later can.');
  }
  const stream = new Blob([T.bytesOf(text)]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
};

// A column from its planes of bytes: differences, folded so that small ones are small.
T.unpack = (bytes, at, column) => {
  const n = column.count;
  const q = new Int32Array(n);
  for (let plane = 0; plane < column.planes; ++plane) {
    const from = at + plane * n;
    for (let i = 0; i < n; ++i) q[i] |= bytes[from + i] << (8 * plane);
  }
  for (let i = 0; i < n; ++i) q[i] = (q[i] >>> 1) ^ -(q[i] & 1);
  for (let k = 0; k < column.order; ++k) {
    for (let i = 1; i < n; ++i) q[i] = (q[i] + q[i - 1]) | 0;
  }
  const whole = column.step === 1;
  if (whole) return q;
  const per = Math.round(1 / column.step);
  const values = column.name === 't_s' ? new Float64Array(n) : new Float32Array(n);
  for (let i = 0; i < n; ++i) values[i] = q[i] / per;
  return values;
};

// A run: its columns by short names, and what is computed from them.
T.readRun = async (meta, number) => {
  const bytes = await T.inflate(meta.data);
  meta.data = '';
  const c = {};
  let at = 0;
  for (const column of meta.columns) {
    c[column.name] = T.unpack(bytes, at, column);
    at += column.planes * column.count;
  }
  const run = T.runOf(meta, number, c);
  if (meta.outline) {
    run.outline = {lifts: meta.lifts};
    for (const [k, column] of meta.outline.entries()) {
      run.outline[k ? 'y' : 'x'] = T.unpack(bytes, at, column);
      at += column.planes * column.count;
    }
    if (meta.text_bytes > 0) run.text = T.linesOf(bytes.subarray(at, at + meta.text_bytes));
  }
  T.derive(run, c.rapid);
  return run;
};

T.linesOf = (bytes) => {
  const lines = new TextDecoder().decode(bytes).split(/\r\n|\n|\r/);
  if (lines[lines.length - 1] === '') lines.pop();
  return lines;
};

T.runOf = (meta, number, c) => {
  const run = {meta, number, name: meta.name, summary: meta.summary, n: c.t_s.length, t: c.t_s,
    x: c.x_cmd_mm, y: c.y_cmd_mm, z: c.z_cmd_mm || new Float32Array(c.t_s.length), line: c.line, segment: c.segment,
    f: c.feedrate_mm_per_s, e: c.contour_error_signed_um || c.contour_error_um, ex: c.x_tracking_error_um,
    ey: c.y_tracking_error_um, ux: c.x_drive_V, uy: c.y_drive_V, tx: c.x_torque_Nm, ty: c.y_torque_Nm,
    rx: c.x_friction_N, ry: c.y_friction_N, acc: c.acceleration_mm_per_s2, limit: c.feedrate_limit_mm_per_s,
    table: c.table_contour_error_signed_um, command: c.command_contour_error_signed_um, outline: null, text: null};
  return run;
};

T.kinds = {cut: 0, rapid: 1, up: 2};

// Heights of the pen above the program's Z0, which the summary tells where it is not that of the machine.
T.heights = (run) => {
  const changes = run.summary.program_zero_mm || [];
  let next = 0, zero = 0;
  return run.z.map((z, i) => {
    for (; next < changes.length && changes[next][0] <= run.t[i]; ++next) zero = changes[next][1];
    return z - zero;
  });
};

T.derive = (run, rapid) => {
  const {n, t, x, y, z, f} = run;
  const period = run.summary.period_s || (n > 1 ? t[1] - t[0] : 1e-3);
  run.period = period;
  run.s = new Float64Array(n);
  for (let i = 1; i < n; ++i) run.s[i] = run.s[i - 1] + Math.hypot(x[i] - x[i - 1], y[i] - y[i - 1], z[i] - z[i - 1]);
  if (run.ex && run.ey) {
    run.track = new Float32Array(n);
    for (let i = 0; i < n; ++i) run.track[i] = Math.hypot(run.ex[i], run.ey[i]);
  }
  if (f) {
    run.at = new Float32Array(n);
    run.jerk = new Float32Array(n);
    const even = (i) => Math.abs(t[i + 1] - 2 * t[i] + t[i - 1]) < 1e-7;
    for (let i = 1; i + 1 < n; ++i) {
      if (!even(i)) continue;
      const h = t[i + 1] - t[i];
      run.at[i] = (f[i + 1] - f[i - 1]) / (2 * h);
      run.jerk[i] = (f[i + 1] - 2 * f[i] + f[i - 1]) / (h * h);
    }
  }
  // Cutting motion, rapids, pen up where the program ever lowers it.
  run.kind = new Uint8Array(n);
  const rapids = new Set(run.meta.rapid_lines || []);
  let lowers = false;
  run.height = T.heights(run);
  for (let i = 0; i < n && !lowers; ++i) lowers = run.height[i] <= 0.1;
  for (let i = 0; i < n; ++i) {
    if (rapid ? rapid[i] : run.line && rapids.has(run.line[i])) run.kind[i] = T.kinds.rapid;
    else if (lowers && run.height[i] > 0.1) run.kind[i] = T.kinds.up;
  }
  if (run.e) {
    run.absE = run.e.map(Math.abs);
    if (!run.meta.thinned) run.rms = T.movingRms(run.e, Math.max(1, Math.round(0.05 / period)));
  }
};

// Root mean square over 2 w + 1 rows.
T.movingRms = (v, w) => {
  const n = v.length;
  const sums = new Float64Array(n + 1);
  for (let i = 0; i < n; ++i) sums[i + 1] = sums[i] + v[i] * v[i];
  const r = new Float32Array(n);
  for (let i = 0; i < n; ++i) {
    const a = Math.max(0, i - w);
    const b = Math.min(n, i + w + 1);
    r[i] = Math.sqrt((sums[b] - sums[a]) / (b - a));
  }
  return r;
};

// Last index whose value is not above v, in ascending values.
T.indexAt = (values, v) => {
  let lo = 0;
  let hi = values.length - 1;
  while (lo < hi) {
    const mid = (lo + hi + 1) >> 1;
    if (values[mid] <= v) lo = mid;
    else hi = mid - 1;
  }
  return lo;
};

T.nearestIndex = (values, v) => {
  const i = T.indexAt(values, v);
  return i + 1 < values.length && values[i + 1] - v < v - values[i] ? i + 1 : i;
};

// Values of a run at the abscissas of another one.
T.resample = (from, values, to) => {
  const out = new Float32Array(to.length);
  let k = 0;
  const last = from.length - 1;
  for (let i = 0; i < to.length; ++i) {
    while (k < last && from[k + 1] < to[i]) ++k;
    const a = from[k];
    const b = from[Math.min(k + 1, last)];
    const share = b > a ? Math.min(1, Math.max(0, (to[i] - a) / (b - a))) : 0;
    out[i] = to[i] > from[last] + 1e-9 ? NaN : values[k] + share * (values[Math.min(k + 1, last)] - values[k]);
  }
  return out;
};
