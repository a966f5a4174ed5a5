// What is shown of a run: names, units, limits; colours; text of numbers; what happens where.

T.quantities = [
  {key: 'feed', name: 'Feedrate', unit: 'mm/s', digits: 2, series: [['limit', 'limit in force', 'thin'], ['f', 'set point']]},
  {key: 'error', name: 'Contour error', unit: 'µm', digits: 2, series: [['e', 'encoder', 'faint'], ['rms', 'RMS over 0.1 s', 'strong'], ['table', 'table'], ['command', 'command']]},
  {key: 'track', name: 'Tracking error', unit: 'µm', digits: 1, series: [['ex', 'x'], ['ey', 'y']]},
  {key: 'acc', name: 'Acceleration', unit: 'mm/s²', digits: 0, series: [['at', 'tangential'], ['acc', 'in all']], bound: 'acceleration_mm_per_s2'},
  {key: 'jerk', name: 'Tangential jerk', unit: 'mm/s³', digits: 0, series: [['jerk', 'set point']], bound: 'jerk_mm_per_s3'},
  {key: 'drive', name: 'Drive command', unit: 'V', digits: 3, series: [['ux', 'x'], ['uy', 'y']]},
  {key: 'torque', name: 'Motor torque', unit: 'N·m', digits: 3, series: [['tx', 'x'], ['ty', 'y']]},
  {key: 'friction', name: 'Friction', unit: 'N', digits: 1, series: [['rx', 'x'], ['ry', 'y']]},
  {key: 'height', name: 'Z', unit: 'mm', digits: 3, series: [['z', 'set point']]},
];

// By which the path is coloured.
T.colourings = [
  {key: 'absE', name: 'contour error', unit: 'µm', digits: 2},
  {key: 'f', name: 'feedrate', unit: 'mm/s', digits: 1},
  {key: 'track', name: 'tracking error', unit: 'µm', digits: 1},
  {key: 'acc', name: 'acceleration', unit: 'mm/s²', digits: 0},
  {key: 'jerk', name: 'tangential jerk', unit: 'mm/s³', digits: 0, size: true},
];

// Viridis, in steps of an eighth; every colour between them is linear.
T.viridis = [[68, 1, 84], [71, 44, 122], [59, 81, 139], [44, 113, 142], [33, 144, 141], [39, 173, 129], [92, 200, 99], [170, 220, 50], [253, 231, 37]];
// The dark end is lifted on a dark ground and the light end lowered on a light one, so that both are seen.
T.shade = (share, dark = T.isDark()) => {
  const span = dark ? [0.16, 1] : [0, 0.9];
  const u = 8 * (span[0] + Math.min(1, Math.max(0, share)) * (span[1] - span[0]));
  const k = Math.min(7, Math.floor(u));
  return T.viridis[k].map((a, i) => Math.round(a + (u - k) * (T.viridis[k + 1][i] - a)));
};
T.colourCount = 48;
T.ramp = () => Array.from({length: T.colourCount}, (_, k) => `rgb(${T.shade(k / (T.colourCount - 1))})`);

// Okabe and Ito's colours, for runs and axes.
T.category = (k) => {
  const dark = ['#56b4e9', '#e69f00', '#009e73', '#cc79a7', '#f0e442', '#d55e00'];
  const light = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#b07d00', '#56b4e9'];
  return (T.isDark() ? dark : light)[k % 6];
};
T.isDark = () => document.documentElement.dataset.theme === 'dark';
T.css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

// Text of a number, with a thin space between thousands.
T.number = (v, digits) => {
  if (v === null || v === undefined || !Number.isFinite(v)) return '–';
  let text = (v + 1e-10 * v).toFixed(digits);  // a half is rounded away from zero
  if (/^-0(\.0*)?$/.test(text)) text = text.slice(1);
  const [whole, rest] = text.replace('-', '−').split('.');
  const grouped = whole.replace(/\B(?=(\d{3})+(?!\d))/g, '\u202f');
  return rest === undefined ? grouped : `${grouped}.${rest}`;
};

T.limitsOf = (run) => (run.summary.settings || {}).limits || {};

// Extremes of the directions of motion around a row.
T.motionAt = (run, i) => {
  const {x, y, n} = run;
  const step = (a, b) => [x[b] - x[a], y[b] - y[a]];
  const w = 6;
  const a = Math.max(0, i - w);
  const b = Math.min(n - 1, i + w);
  const before = step(a, i);
  const after = step(i, b);
  const turn = Math.atan2(before[0] * after[1] - before[1] * after[0], before[0] * after[0] + before[1] * after[1]);
  const length = (Math.hypot(...before) + Math.hypot(...after)) / 2;
  const angle = Math.abs(turn);
  return {angle, radius: angle > 1e-4 && length > 0 ? length / angle : Infinity};
};

// What happens at a row, in words.
T.whatHappens = (run, i) => {
  const {x, y, n} = run;
  const words = [];
  const w = Math.max(4, Math.round(0.02 / run.period));
  for (const [name, p] of [['X', x], ['Y', y]]) {
    let sign = 0;
    for (let k = Math.max(1, i - w); k <= Math.min(n - 1, i + 3); ++k) {
      const d = p[k] - p[k - 1];
      if (Math.abs(d) < 2e-5) continue;
      if (sign && Math.sign(d) !== sign) {
        words.push(`${name} reverses`);
        break;
      }
      sign = Math.sign(d);
    }
  }
  const {angle, radius} = T.motionAt(run, i);
  const a = T.limitsOf(run).acceleration_mm_per_s2 || Infinity;
  if (radius < 1 && angle > 0.35) words.unshift(`corner of ${Math.round(angle * 180 / Math.PI)}°`);
  else if (radius < 100) words.push(`curve of R ${T.number(radius, radius < 10 ? 1 : 0)} mm`);
  if (run.at && Math.abs(run.at[i]) > 0.5 * a) words.push(run.at[i] > 0 ? 'speeds up' : 'brakes');
  return words.length ? words.join(', ') : 'straight, steady';
};

// The largest contour errors of cutting motion, a tenth of a second apart at least.
T.worstPlaces = (run, count) => {
  if (!run.absE) return [];
  const cell = Math.max(1, Math.round(0.01 / run.period));
  const tops = [];
  for (let a = 0; a < run.n; a += cell) {
    let best = -1;
    for (let i = a; i < Math.min(run.n, a + cell); ++i) {
      if (run.kind[i] === T.kinds.cut && (best < 0 || run.absE[i] > run.absE[best])) best = i;
    }
    if (best >= 0) tops.push(best);
  }
  tops.sort((a, b) => run.absE[b] - run.absE[a]);
  const chosen = [];
  for (const i of tops) {
    if (chosen.length === count) break;
    if (chosen.every((k) => Math.abs(run.t[k] - run.t[i]) > 0.1)) chosen.push(i);
  }
  return chosen;
};
