// Tables and figures beside path and curves.

T.escape = (text) => String(text).replace(/[&<>"]/g, (c) => ({'&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;'}[c]));
T.el = (id) => document.getElementById(id);

T.tipText = (run, i) => {
  const rows = [`line ${run.line ? run.line[i] : '–'} · ${T.number(run.t[i], 3)} s`, `X ${T.number(run.x[i], 3)}  Y ${T.number(run.y[i], 3)} mm`];
  if (run.f) rows.push(`${T.number(run.f[i], 1)} mm/s`);
  if (run.e) rows.push(`contour error ${T.number(run.e[i], 2)} µm`);
  return rows.join('<br>');
};

// What is true at the cursor.
T.showNow = (state) => {
  const run = state.runs[0];
  const i = state.index;
  const kinds = ['cutting', 'rapid', 'pen up'];
  const rows = [['time', `${T.number(run.t[i], 3)} s`, 't'], ['path', `${T.number(run.s[i], 3)} mm`, 's'],
    ['X', `${T.number(run.x[i], 3)} mm`, 'x'], ['Y', `${T.number(run.y[i], 3)} mm`, 'y'], ['Z', `${T.number(run.z[i], 3)} mm`, 'z'],
    ['NC line', run.line ? `${run.line[i]}` : '–', 'line'], ['motion', kinds[run.kind[i]], 'kind']];
  if (run.f) rows.push(['feedrate', `${T.number(run.f[i], 2)} mm/s`, 'f']);
  if (run.e) rows.push(['contour error', `${T.number(run.e[i], 3)} µm`, 'e']);
  if (run.ex) rows.push(['tracking error x', `${T.number(run.ex[i], 2)} µm`, 'ex'], ['tracking error y', `${T.number(run.ey[i], 2)} µm`, 'ey']);
  if (run.ux) rows.push(['drive x, y', `${T.number(run.ux[i], 2)}, ${T.number(run.uy[i], 2)} V`, 'u']);
  T.el('now').innerHTML = rows.map(([k, v, id]) => `<div><dt>${k}</dt><dd data-now="${id}">${v}</dd></div>`).join('');
};

T.keyFigures = (state) => {
  const s = state.runs[0].summary;
  const figure = (name, value, digits, unit, more) => (value === undefined || value === null ? '' :
    `<div><div class="k">${name}</div><div class="v">${T.number(value, digits)} <small>${unit}</small></div>${more ? `<div class="more">${more}</div>` : ''}</div>`);
  const cut = s.cutting || {};
  const rms = (e) => (e ? `RMS ${T.number(e.rms, 2)} µm` : '');
  const tracking = s.tracking_error_um;
  return [
    s.machining_time_s !== undefined ? figure('Machining time', s.machining_time_s, 3, 's', cut.time_s ? `cutting ${T.number(cut.time_s, 3)} s` : '')
      : figure('Planned time', s.planned_time_s, 3, 's', cut.time_s ? `cutting ${T.number(cut.time_s, 3)} s` : ''),
    s.contour_error_um ? figure('Contour error, largest', s.contour_error_um.max, 3, 'µm', rms(s.contour_error_um))
      : figure('Contour error of the command', (s.command_contour_error_um || {}).max, 3, 'µm', rms(s.command_contour_error_um)),
    cut.contour_error_um && Math.abs(cut.contour_error_um.max - s.contour_error_um.max) > 1e-6 ? figure('Cutting alone', cut.contour_error_um.max, 3, 'µm', rms(cut.contour_error_um)) : '',
    tracking ? figure('Tracking error, largest', Math.max(tracking.x.max, tracking.y.max), 1, 'µm', `x ${T.number(tracking.x.max, 1)}, y ${T.number(tracking.y.max, 1)}`) : '',
    figure('Path', s.path_length_mm, 1, 'mm', s.blocks ? `${T.number(s.blocks.total, 0)} blocks, ${T.number((s.segments || {}).total, 0)} segments` : ''),
    figure('Feedrate, largest', (s.audit || {}).feedrate_mm_per_s, 1, 'mm/s', ''),
    s.certified_deviation_um !== undefined ? figure('Certified deviation', s.certified_deviation_um, 3, 'µm', 'of path and program') : '',
  ].join('');
};

T.showWorst = (state) => {
  const run = state.runs[0];
  const host = T.el('worst');
  if (!run.worst.length) {
    host.innerHTML = '<p class="unit">A plan has none: no machine moves.</p>';
    return;
  }
  host.innerHTML = `<table><thead><tr><th></th><th>µm</th><th>time, s</th><th>line</th><th class="text">there</th></tr></thead><tbody>${run.worst.map((i, k) =>
    `<tr class="go" data-go="${i}" tabindex="0"><td>${k + 1}</td><td><b>${T.number(run.absE[i], 3)}</b></td><td>${T.number(run.t[i], 3)}</td><td>${run.line ? run.line[i] : '–'}</td><td class="text" title="X ${T.number(run.x[i], 3)} Y ${T.number(run.y[i], 3)} mm">${T.whatHappens(run, i)}</td></tr>`).join('')}</tbody></table>`;
};

// The NC program: only the lines in sight are elements.
T.ProgramView = class {
  constructor(host, state) {
    this.host = host;
    this.inner = host.firstElementChild;
    this.state = state;
    this.run = state.runs[0];
    this.text = this.run.text;
    const note = this.run.meta.note;
    if (!this.text) {
      this.inner.innerHTML = `<span class="unit">${T.escape(note || 'The NC program is not part of this page.')}</span>`;
      this.inner.style.font = '13px/1.4 system-ui, sans-serif';
      this.inner.style.padding = '8px 0';
      return;
    }
    T.el('program-title').textContent = `NC program, ${T.number(this.text.length, 0)} lines`;
    this.scale = Math.min(1, 8e6 / (this.text.length * 18));  // browsers end at about 10^7 px
    this.inner.style.height = `${this.text.length * 18 * this.scale}px`;
    host.addEventListener('scroll', () => this.draw());
    this.inner.addEventListener('click', (event) => {
      const line = event.target.closest('p');
      if (line) this.go(Number(line.dataset.line));
    });
    new ResizeObserver(() => this.draw()).observe(host);
  }

  go(line) {
    const i = T.firstOfLine(this.run, line);
    if (i >= 0) this.state.set(i, 'program');
  }

  mark(line) {
    if (!this.text || line === this.line) return;
    this.line = line;
    const y = (line - 1) * 18 * this.scale;
    const {scrollTop, clientHeight} = this.host;
    if (y < scrollTop + 18 || y > scrollTop + clientHeight - 36) this.host.scrollTop = y - clientHeight / 2;
    this.draw();
  }

  draw() {
    if (!this.text) return;
    const first = Math.max(0, Math.floor(this.host.scrollTop / 18 / this.scale) - 4);
    const last = Math.min(this.text.length, first + Math.ceil(this.host.clientHeight / 18) + 9);
    let html = '';
    for (let k = first; k < last; ++k) {
      const y = this.scale === 1 ? k * 18 : this.host.scrollTop + (k - first - 4) * 18;
      html += `<p data-line="${k + 1}" style="top:${y}px"${k + 1 === this.line ? ' class="on"' : ''}><b>${k + 1}</b>${T.escape(this.text[k].slice(0, 300))}</p>`;
    }
    this.inner.innerHTML = html;
  }
};

// The first row of a line, or of the next one that moves.
T.firstOfLine = (run, line) => {
  if (!run.line) return -1;
  let best = -1;
  for (let i = 0; i < run.n; ++i) {
    if (run.line[i] === line) return i;
    if (run.line[i] > line && (best < 0 || run.line[i] < run.line[best])) best = i;
  }
  return best;
};

// What the shadow saw: a strip for each axis, how near its largest statistic came to the threshold.
T.showShadow = (state) => {
  const run = state.runs[0];
  const host = T.el('shadow');
  const shadow = state.runs.length > 1 ? null : run.meta.shadow;
  host.hidden = !shadow;
  if (!shadow) return;
  const end = run.t[run.n - 1] || 1;
  const axes = Object.entries(shadow.axes || {});
  const strip = ([name, axis], k) => {
    const t = axis.strip.t_s;
    const bars = t.map((at, i) => {
      const level = axis.strip.level[i];
      const share = Math.min(1, Math.log1p(level) / Math.log1p(10));
      const width = Math.max(1, ((t[i + 1] ?? end) - at) / end * 1000);
      return `<rect x="${(at / end * 1000).toFixed(1)}" y="${(28 * (1 - share) + 40 * k).toFixed(1)}" width="${Math.min(width, 20).toFixed(1)}" height="${(28 * share).toFixed(1)}" fill="${level >= 1 ? 'var(--bad)' : T.category(k)}"><title>${name} ${T.number(at, 2)} s: ${T.number(level, 2)} of the threshold</title></rect>`;
    }).join('');
    const threshold = 28 * (1 - Math.log1p(1) / Math.log1p(10)) + 40 * k;
    const found = axis.finding ? `<line x1="${axis.finding.found_s / end * 1000}" x2="${axis.finding.found_s / end * 1000}" y1="${40 * k}" y2="${28 + 40 * k}" stroke="var(--bad)" stroke-width="2"/>` : '';
    return `${bars}<line x1="0" x2="1000" y1="${threshold}" y2="${threshold}" stroke="currentColor" stroke-dasharray="4 4" stroke-width="0.7"/>${found}`;
  };
  const row = ([name, axis]) => {
    const found = axis.finding_at_the_end;
    const text = found ? `<b>${T.escape(found.words)}</b>${found.cannot_be_told_from.length ? `, cannot be told from ${T.escape(found.cannot_be_told_from.join(', '))}` : ''}` : 'nothing has changed';
    return `<tr${found ? ` class="go" data-time="${found.since_s}" tabindex="0"` : ''}><td>${name}</td><td class="text">${text}</td><td>${found ? T.number(found.since_s, 2) : '–'}</td><td>${found ? found.since_line : '–'}</td><td>${found ? T.number(axis.finding.found_s, 2) : '–'}</td></tr>`;
  };
  const more = [shadow.switched_off ? `Switched off: ${shadow.switched_off}.` : '', `One false alarm in ${T.number(shadow.false_alarm_hours, 0)} h.`, ...shadow.trends].filter(Boolean);
  host.innerHTML = `<h2>Shadow <span class="unit">learnt from ${T.escape((shadow.learnt_from || []).slice(0, 5).join(', '))}</span></h2><svg viewBox="0 0 1000 ${40 * axes.length}" preserveAspectRatio="none" style="width:100%;height:${44 * axes.length}px" role="img" aria-label="Statistic over threshold">${axes.map(strip).join('')}</svg><div class="scroll"><table><thead><tr><th>axis</th><th class="text">what has changed</th><th>since, s</th><th>line</th><th>seen at, s</th></tr></thead><tbody>${axes.map(row).join('')}</tbody></table></div><p class="unit">${more.map(T.escape).join(' ')}</p>`;
};

// A table of the errors, with the place of each maximum; a column for each of several runs.
T.showErrors = (state) => {
  const runs = state.runs;
  const rows = [['contour error, encoder', 'contour_error_um', 'contour_error_max_um'], ['contour error, table', 'table_contour_error_um', 'table_contour_error_max_um'],
    ['contour error, command', 'command_contour_error_um', 'command_contour_error_max_um'], ['tracking error, x', 'tracking_error_um.x', 'x_tracking_error_max_um'], ['tracking error, y', 'tracking_error_um.y', 'y_tracking_error_max_um']];
  const find = (s, path) => path.split('.').reduce((o, k) => (o ? o[k] : undefined), s);
  const cell = (run, path, what) => {
    const value = (find(run.summary, path) || {})[what];
    return `<td>${T.number(value, 3)}</td>`;
  };
  const line = ([name, path, key]) => {
    if (runs.every((run) => !find(run.summary, path))) return '';
    const place = (runs[0].summary.maxima || {})[key];
    const where = runs.length > 1 ? '' : place ? `<td>${T.number(place.t_s, 3)}</td><td>${place.line}</td>` : '<td>–</td><td>–</td>';
    return `<tr${place && runs.length === 1 ? ` class="go" data-time="${place.t_s}" tabindex="0"` : ''}><td>${name}</td>${runs.map((run) => cell(run, path, 'max') + cell(run, path, 'rms')).join('')}${where}</tr>`;
  };
  const cut = (run) => run.summary.cutting && run.summary.cutting.contour_error_um;
  const differs = (run) => cut(run) && Math.abs(cut(run).max - run.summary.contour_error_um.max) + Math.abs(cut(run).rms - run.summary.contour_error_um.rms) > 1e-6;
  const cuts = runs.some(differs) ? `<tr><td>contour error, cutting alone</td>${runs.map((run) => `<td>${T.number((cut(run) || {}).max, 3)}</td><td>${T.number((cut(run) || {}).rms, 3)}</td>`).join('')}${runs.length === 1 ? '<td></td><td></td>' : ''}</tr>` : '';
  const times = runs.length > 1 ? `<tr><td>time, s</td>${runs.map((run) => `<td colspan="2">${T.number(run.summary.machining_time_s ?? run.summary.planned_time_s, 3)}</td>`).join('')}</tr>` : '';
  T.el('errors').innerHTML = `<h2>Errors <span class="unit">in µm</span></h2><div class="scroll"><table><thead>${runs.length > 1 ?
    `<tr><th></th>${runs.map((run) => `<th colspan="2"><i class="swatch" style="border-color:${T.category(run.number)}"></i>${T.escape(run.name)}</th>`).join('')}</tr>` : ''}<tr><th></th>${runs.map(() => '<th>max</th><th>RMS</th>').join('')}${runs.length === 1 ? '<th>at, s</th><th>line</th>' : ''}</tr></thead><tbody>${rows.map(line).join('')}${cuts}${times}</tbody></table></div>`;
};

// Peaks of the set points against the limits, as the audit found them.
T.showLimits = (state) => {
  const run = state.runs[0];
  const limits = T.limitsOf(run);
  const audit = run.summary.audit || {};
  const places = run.summary.maxima || {};
  const rows = [['feedrate', 'mm/s', 'feedrate_mm_per_s', limits.feedrate_mm_per_min / 60, 'feedrate_peak_mm_per_s'],
    ['tangential acceleration', 'mm/s²', 'tangential_acceleration_mm_per_s2', limits.acceleration_mm_per_s2, 'tangential_acceleration_peak_mm_per_s2'],
    ['normal acceleration', 'mm/s²', 'normal_acceleration_mm_per_s2', limits.acceleration_mm_per_s2, 'normal_acceleration_peak_mm_per_s2'],
    ['tangential jerk', 'mm/s³', 'tangential_jerk_mm_per_s3', limits.jerk_mm_per_s3, 'tangential_jerk_peak_mm_per_s3']];
  const verdict = (share) => (!Number.isFinite(share) ? '–' : share <= 1.0005 ? 'kept' : share <= 1.05 ? 'kept, doubt 5 %' : '<span class="over">exceeded</span>');
  T.el('limits').innerHTML = `<h2>Limits <span class="unit">audit of the set points, by their differences</span></h2><div class="scroll"><table><thead><tr><th></th><th>peak</th><th>limit</th><th>at, s</th><th class="text">verdict</th></tr></thead><tbody>${rows.map(([name, unit, key, limit, place]) => {
    const share = audit[key] / limit;
    const at = places[place];
    return `<tr${at ? ` class="go" data-time="${at.t_s}" tabindex="0"` : ''}><td>${name} <small>${unit}</small></td><td>${T.number(audit[key], 1)}</td><td>${T.number(limit, 1)}</td><td>${at ? T.number(at.t_s, 3) : '–'}</td><td class="text">${verdict(share)}</td></tr>`;
  }).join('')}</tbody></table></div>${T.loops(run)}`;
};

// Position loops, as the machine file's model has them.
T.loops = (run) => {
  const loops = run.summary.loops;
  if (!loops) return '';
  const row = (name) => `<tr><td>position loop, ${name}</td><td>${T.number(loops[name].bandwidth_Hz, 1)}</td><td>${T.number(loops[name].phase_margin_deg, 1)}</td><td>${T.number(loops[name].gain_margin, 2)}</td></tr>`;
  return `<table class="loops"><thead><tr><th></th><th>bandwidth, Hz</th><th>phase margin, °</th><th>gain margin</th></tr></thead><tbody>${row('x')}${row('y')}</tbody></table>`;
};

// Bars as SVG. A bar has a share, or shares of several runs side by side.
T.bars = (shares, colours, texts) => {
  const [w, h, left, bottom] = [460, 170, 30, 26];
  const top = Math.max(...shares.flat(), 1e-9);
  const n = shares[0].length;
  const step = (w - left) / n;
  const each = (step - 1.5) / shares.length;
  let out = `<line x1="${left}" x2="${w}" y1="${h - bottom}" y2="${h - bottom}" stroke="var(--line)"/><text x="${left - 5}" y="14" text-anchor="end">${T.number(100 * top, top < 0.1 ? 1 : 0)} %</text>`;
  shares.forEach((row, r) => row.forEach((share, k) => {
    const height = share / top * (h - bottom - 8);
    out += `<rect x="${(left + k * step + r * each).toFixed(1)}" y="${(h - bottom - height).toFixed(1)}" width="${each.toFixed(1)}" height="${height.toFixed(1)}" fill="${colours(r, k)}" rx="1"><title>${texts[k]}: ${T.number(100 * share, 2)} %</title></rect>`;
  }));
  return {svg: (labels) => `<svg class="bars" viewBox="0 0 ${w} ${h}" role="img">${out}${labels.map(([share, text]) => `<text x="${left + share * (w - left)}" y="${h - 9}" text-anchor="${share === 0 ? 'start' : share === 1 ? 'end' : 'middle'}">${text}</text>`).join('')}</svg>`};
};

T.showHistogram = (state) => {
  const runs = state.runs.filter((run) => run.absE);
  if (!runs.length) { T.el('histogram').innerHTML = '<p class="unit">A plan has none.</p>'; return; }
  const bins = runs.length > 1 ? 20 : 36;
  if (runs.some((run) => run.meta.thinned)) {
    T.el('histogram').innerHTML = '<p class="unit">Not shown: of this many rows the page has those with extremes only.</p>';
    return;
  }
  let top = 0;
  for (const run of runs) for (let i = 0; i < run.n; ++i) if (run.kind[i] === 0 && run.absE[i] > top) top = run.absE[i];
  top = top || 1;
  const shares = runs.map((run) => {
    const count = new Float64Array(bins);
    let all = 0;
    for (let i = 0; i < run.n; ++i) {
      if (run.kind[i] !== 0) continue;
      count[Math.min(bins - 1, Math.floor(run.absE[i] / top * bins))] += 1;
      ++all;
    }
    return [...count].map((c) => c / Math.max(1, all));
  });
  const ramp = T.ramp();
  const colours = (r, k) => (runs.length > 1 ? T.category(runs[r].number) : ramp[Math.min(T.colourCount - 1, Math.floor((k + 0.5) / bins * top / state.errorTop * T.colourCount))]);
  const texts = Array.from({length: bins}, (_, k) => `${T.number(top * k / bins, 2)} to ${T.number(top * (k + 1) / bins, 2)} µm`);
  T.el('histogram').innerHTML = T.bars(shares, colours, texts).svg([[0, '0'], [0.5, T.number(top / 2, 1)], [1, `${T.number(top, 1)} µm`]]) + '<p class="unit">share of the cutting time</p>';
};

// How long each feedrate was driven, and what kept it from being higher.
T.showFeeds = (state) => {
  const run = state.runs[0];
  if (!run.f) { T.el('feeds').innerHTML = '<p class="unit">The trace has no feedrate.</p>'; return; }
  if (run.meta.thinned) {
    T.el('feeds').innerHTML = '<p class="unit">Not shown: of this many rows the page has those with extremes only.</p>';
    return;
  }
  const limits = T.limitsOf(run);
  const [a, j] = [limits.acceleration_mm_per_s2 || Infinity, limits.jerk_mm_per_s3 || Infinity];
  const bins = 20;
  let top = 0;
  for (let i = 0; i < run.n; ++i) top = Math.max(top, run.f[i]);
  top = top || 1;
  const count = new Float64Array(bins);
  const why = {'feedrate limit in force': 0, 'jerk': 0, 'acceleration': 0, 'at rest': 0, 'steady feedrate': 0, 'other': 0};
  for (let i = 0; i < run.n; ++i) {
    count[Math.min(bins - 1, Math.floor(run.f[i] / top * bins))] += 1;
    if (run.f[i] < 1e-6) ++why['at rest'];
    else if (run.limit && run.f[i] > 0.98 * run.limit[i]) ++why['feedrate limit in force'];
    else if (Math.abs(run.jerk[i]) > 0.9 * j) ++why.jerk;
    else if (Math.abs(run.at[i]) > 0.95 * a) ++why.acceleration;
    else if (!run.limit && Math.abs(run.at[i]) < 1) ++why['steady feedrate'];
    else ++why.other;
  }
  const shares = [[...count].map((c) => c / run.n)];
  const texts = Array.from({length: bins}, (_, k) => `${T.number(top * k / bins, 1)} to ${T.number(top * (k + 1) / bins, 1)} mm/s`);
  const rows = Object.entries(why).filter(([, v]) => v > 0.005 * run.n).sort((p, q) => q[1] - p[1]);
  T.el('feeds').innerHTML = `${T.bars(shares, () => T.category(0), texts).svg([[0, '0'], [0.5, T.number(top / 2, 0)], [1, `${T.number(top, 0)} mm/s`]])}<p class="unit">share of the time; bounded by ${rows.map(([name, v]) => `${name} ${T.number(100 * v / run.n, 0)} %`).join(', ')}</p>`;
};

// Settings; of several runs those that differ first.
T.showSettings = (state) => {
  const runs = state.runs;
  const text = (v) => (v === undefined ? '–' : Array.isArray(v) ? v.join(', ') : String(v));
  const sections = runs[0].summary.settings || {};
  const differing = [];
  if (runs.length > 1) {
    const all = new Set(runs.flatMap((run) => Object.entries(run.summary.settings || {}).flatMap(([s, keys]) => Object.keys(keys).map((k) => `${s}\n${k}`))));
    for (const name of all) {
      const [s, k] = name.split('\n');
      const values = runs.map((run) => text(((run.summary.settings || {})[s] || {})[k]));
      if (values.some((v) => v !== values[0])) differing.push([`${s}.${k}`, values]);
    }
  }
  const differ = runs.length > 1 ? `<h2>Settings that differ</h2>${differing.length ? `<div class="scroll"><table><thead><tr><th></th>${runs.map((run) => `<th><i class="swatch" style="border-color:${T.category(run.number)}"></i>${T.escape(run.name)}</th>`).join('')}</tr></thead><tbody>${differing.map(([name, values]) => `<tr><td>${T.escape(name)}</td>${values.map((v) => `<td>${T.escape(v)}</td>`).join('')}</tr>`).join('')}</tbody></table></div>` : '<p class="unit">none</p>'}` : '';
  const commands = runs.map((run) => run.summary.command).filter(Boolean).map((c) => `<code>${T.escape(c)}</code>`).join('<br>');
  const list = Object.entries(sections).map(([section, keys]) => `<div><h3>${T.escape(section)}</h3><table>${Object.entries(keys).map(([k, v]) => `<tr><td>${T.escape(k)}</td><td>${T.escape(text(v))}</td></tr>`).join('')}</table></div>`).join('');
  if (differ) T.el('differ').innerHTML = differ;
  T.el('settings').innerHTML = `${commands ? `<h2>Made by</h2>${commands}<br>` : ''}<details><summary><b>Settings used</b> <span class="unit">${runs.length > 1 ? `of ${T.escape(runs[0].name)}` : ''}</span></summary><div class="settings">${list}</div></details>`;
};
