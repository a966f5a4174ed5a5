// Puts the page together: state, cursor, keys.

T.State = class {
  constructor(runs) {
    this.runs = runs;
    this.index = 0;
    this.magnify = 0;
    this.showProgram = true;
    this.showRapids = true;
    this.differences = false;
    this.listeners = [];
    this.colour(T.colourings.find((c) => runs[0][c.key]));
    this.errorTop = runs[0].absE ? T.topOf(runs[0], 'absE') : 1;
  }

  colour(colouring) {
    this.colouring = colouring;
    this.range = colouring ? [0, T.topOf(this.runs[0], colouring.key)] : [0, 1];
  }

  // Row of another run where the first one's cursor is: at the same length of path.
  indexOf(run) {
    if (run === this.runs[0]) return Math.min(this.index, run.n - 1);
    return this.byTime ? T.indexAt(run.t, this.runs[0].t[this.index]) : T.indexAt(run.s, this.runs[0].s[this.index]);
  }

  set(index, from) {
    index = Math.max(0, Math.min(this.runs[0].n - 1, index));
    if (index === this.index && from !== 'start') return;
    this.index = index;
    this.listeners.forEach((listen) => listen(from));
  }
};

// The value that one in 200 rows exceeds: the colours are not spent on a single peak.
T.topOf = (run, key) => {
  const stride = Math.max(1, Math.floor(run.n / 100000));
  const values = [];
  for (let i = 0; i < run.n; i += stride) if (run.kind[i] === 0) values.push(Math.abs(run[key][i]));
  values.sort((a, b) => a - b);
  return values[Math.floor(0.995 * (values.length - 1))] || values[values.length - 1] || 1;
};

T.setTheme = (theme) => { document.documentElement.dataset.theme = theme; };
T.setTheme(matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light');

T.header = (state) => {
  const run = state.runs[0];
  const s = run.summary;
  T.el('name').textContent = state.runs.length > 1 ? state.runs.map((r) => r.name).join('  ·  ') : s.program || run.name;
  const planner = s.planner === 'certified' ? 'certified planner' : [s.planner && `${s.planner} planner`, s.interpolator].filter(Boolean).join(', ');
  T.el('about').textContent = [s.machine && (s.hal === 'none' ? `planned for ${s.machine}` : `on ${s.machine} (${s.hal})`), planner, !run.meta.is_live && `period ${T.number(run.period * 1e3, 3).replace(/\.?0+$/, '')} ms`, s.version && `twin ${s.version}`].filter(Boolean).join(' · ');
  const badges = [];
  if (run.meta.live) badges.push('<span class="badge bad">live</span>');
  if (state.runs.some((r) => r.meta.partial)) badges.push('<span class="badge bad">ended early</span>');
  badges.push(`<span class="badge">${s.hal === 'none' ? 'plan' : s.simulated === false ? 'measured on the machine' : 'simulated'}</span>`);
  T.el('badges').innerHTML = badges.join('');
  const notes = [];
  for (const r of state.runs) {
    const end = r.summary.ended_early;
    if (r.meta.partial) notes.push(`${state.runs.length > 1 ? `${r.name}: ` : ''}This run ended early${end && end.t_s !== undefined ? `, at ${T.number(end.t_s, 3)} s in line ${end.line}` : ''}${end ? `: ${end.reason}` : ''}. What is shown is what was done until then.`);
    if (r.meta.thinned) notes.push(`The trace has ${T.number(r.meta.rows_of_trace, 0)} rows; of these ${T.number(r.n, 0)} are shown, among them the smallest and the largest of each quantity. Acceleration and jerk are known only where rows follow each other.`);
    for (const note of r.summary.notes || []) notes.push(note);
  }
  if (run.meta.live) notes.push('This run is under way; a hundred rows a second are shown.');
  T.el('notice').hidden = !notes.length;
  T.el('notice').textContent = notes.join(' ');
  T.el('keys').innerHTML = state.runs.length > 1 ? '' : T.keyFigures(state);
  T.el('keys').hidden = state.runs.length > 1 || Boolean(run.meta.is_live);
  T.el('errors').hidden = T.el('limits').hidden = Boolean(run.meta.is_live);  // figures of the whole run
};

T.showScale = (state) => {
  const c = state.colouring;
  const runs = state.runs.length > 1 ? state.runs.map((run) => `<div class="kind"><i style="border-color:${T.category(run.number)}"></i>${T.escape(run.name)}</div>`).join('') : '';
  const ramp = state.runs.length > 1 || !c ? '' : `${c.name}, ${c.unit}<div class="ramp" style="background:linear-gradient(90deg,${T.ramp().filter((_, k) => k % 4 === 0).join(',')})"></div><div class="ends"><span>0</span><span>${T.number(state.range[1] / 2, c.digits)}</span><span>≥ ${T.number(state.range[1], c.digits)}</span></div>`;
  const program = state.runs[0].outline && state.showProgram && !state.isSpace ? '<div class="kind"><i style="border-color:var(--program);border-width:1px"></i>programmed</div>' : '';
  T.el('scale').innerHTML = ramp + runs + program;
};

// What is to be seen of a run at first sight.
T.lookAt = (run) => {
  run.worst = T.worstPlaces(run, 5);
  run.hasHeight = run.z.some((v) => v !== run.z[0]);
  run.tools = (run.text || []).map((line, k) => [k + 1, line]).filter(([, line]) => /\bM0?6\b/i.test(line.replace(/\(.*?\)|;.*/g, ''))).map(([k, line]) => [k, (line.match(/T\s*(\d+)/i) || ['', 'T'])[1]]);
};

T.Page = class {
  constructor(runs) {
    const state = this.state = new T.State(runs);
    runs.forEach(T.lookAt);
    if (runs.length > 1) {  // what the runs differ in comes first
      const differ = Object.assign(document.createElement('div'), {id: 'differ', className: 'card'});
      T.el('overview').append(T.el('errors'), differ);
      T.el('overview').hidden = false;
      T.el('feeds').parentElement.hidden = true;
    }
    T.el('main').hidden = false;
    T.header(state);
    this.path = new T.PathView(T.el('path'), state);
    this.scene = new T.Scene(T.el('path'), state);
    this.curves = new T.Curves(T.el('plots'), state);
    this.program = new T.ProgramView(T.el('lines'), state);
    this.controls();
    this.keys();
    state.listeners.push((from) => this.cursorMoved(from));
    this.refresh();
    state.set(runs[0].worst[0] || 0, 'start');
    if (this.state.index === 0) this.cursorMoved('start');
    T.el('foot').innerHTML = 'Keys: <kbd>←</kbd> <kbd>→</kbd> one row, with <kbd>Shift</kbd> ten, <kbd>N</kbd> next large error, <kbd>space</kbd> play, <kbd>+</kbd> <kbd>−</kbd> <kbd>0</kbd> zoom, <kbd>T</kbd> light or dark. This page needs no network.';
  }

  // Everything that depends on colours, runs or what is chosen.
  refresh() {
    const state = this.state;
    T.header(state);
    T.showWorst(state);
    T.showErrors(state);
    T.showLimits(state);
    T.showShadow(state);
    T.showHistogram(state);
    T.showFeeds(state);
    T.showSettings(state);
    T.showScale(state);
    this.scene.isStale = true;
    this.chips();
    this.curves.build();
    this.path.draw();
    this.scene.draw();
    this.program.draw();
  }

  // The same run with more rows. The cursor follows the last one unless it was moved by hand.
  update(run) {
    const {state} = this;
    const isAtEnd = state.index >= state.runs[0].n - 1 || !this.isTouched;
    state.runs[0] = this.program.run = run;
    T.lookAt(run);
    state.colour(T.colourings.find((c) => c.key === (state.colouring || {}).key) || T.colourings.find((c) => run[c.key]));
    state.errorTop = run.absE ? T.topOf(run, 'absE') : 1;
    T.showWorst(state);
    T.showHistogram(state);
    T.showFeeds(state);
    T.showScale(state);
    this.scene.isStale = true;
    this.curves.update();
    if (this.path.isMoved) this.path.draw();
    else this.path.fit();
    if (isAtEnd) state.set(run.n - 1, 'live');
    this.cursorMoved('start');
  }

  cursorMoved(from) {
    const run = this.state.runs[0];
    const i = this.state.index;
    if (from !== 'live' && from !== 'start') this.isTouched = true;
    T.showNow(this.state);
    this.path.drawCursor();
    if (from !== 'path') { this.path.tip.classList.remove('on'); if (from !== 'play' && from !== 'curves' && from !== 'start' && from !== 'live') this.path.show(i); }
    this.curves.showCursor();
    this.scene.draw();
    if (run.line) this.program.mark(run.line[i]);
    T.el('when').value = String(Math.round(1000 * (run.t[i] - run.t[0]) / Math.max(1e-9, run.t[run.n - 1] - run.t[0])));
    document.querySelectorAll('#worst tr.go').forEach((row) => row.classList.toggle('on', Number(row.dataset.go) === i));
  }

  segment(id, choose) {
    T.el(id).addEventListener('click', (event) => {
      const button = event.target.closest('button');
      if (!button) return;
      T.el(id).querySelectorAll('button').forEach((b) => b.classList.toggle('on', b === button));
      choose(button.dataset.v);
    });
  }

  controls() {
    const state = this.state;
    const run = state.runs[0];
    const options = T.colourings.filter((c) => run[c.key]);
    T.el('colour').innerHTML = options.map((c) => `<option value="${c.key}">${c.name}</option>`).join('');
    T.el('colour').addEventListener('change', (event) => {
      state.colour(options.find((c) => c.key === event.target.value));
      T.showScale(state);
      this.scene.isStale = true;
      this.path.draw();
      this.scene.draw();
    });
    T.el('colour').parentElement.hidden = state.runs.length > 1;
    T.el('magnify').innerHTML = [0, 10, 50, 100, 200, 500, 1000].map((m) => `<option value="${m}">${m || 'off'}</option>`).join('');
    T.el('magnify-label').hidden = !run.e;
    T.el('magnify').addEventListener('change', (event) => { state.magnify = Number(event.target.value); this.path.draw(); });
    for (const [id, key] of [['show-program', 'showProgram'], ['show-rapids', 'showRapids']]) {
      T.el(id).addEventListener('change', (event) => { state[key] = event.target.checked; T.showScale(state); this.path.draw(); });
    }
    T.el('show-program').parentElement.hidden = !run.outline;
    T.el('show-rapids').parentElement.hidden = run.kind.every((k) => k === 0);
    this.segment('dimension', (v) => {
      state.isSpace = v === '3';
      T.showScale(state);
      T.el('path').querySelector('.space').hidden = v !== '3';
      this.path.base.hidden = this.path.top.hidden = v === '3';
      this.scene.draw();
    });
    T.el('fit').addEventListener('click', () => { this.path.fit(); this.scene.closeness = 1; this.scene.draw(); });
    T.el('zoom-in').addEventListener('click', () => { this.path.zoom(1.5); this.scene.zoom(1.2); });
    T.el('zoom-out').addEventListener('click', () => { this.path.zoom(1 / 1.5); this.scene.zoom(1 / 1.2); });
    T.el('abscissa').querySelectorAll('button').forEach((b) => b.classList.toggle('on', (b.dataset.v === 's') === this.curves.isOverPath));
    this.segment('abscissa', (v) => { this.curves.isOverPath = v === 's'; state.byTime = v === 't'; this.curves.range = null; this.curves.build(); });
    T.el('differences-label').hidden = state.runs.length < 2;
    T.el('differences').addEventListener('change', (event) => { state.differences = event.target.checked; this.curves.build(); });
    T.el('chips').addEventListener('click', (event) => {
      if (event.target.dataset.key) { this.curves.toggle(event.target.dataset.key); this.chips(); }
    });
    T.el('theme').addEventListener('click', () => { T.setTheme(T.isDark() ? 'light' : 'dark'); this.refresh(); });
    matchMedia('print').addEventListener('change', (event) => {  // paper is light
      if (event.matches) this.theme = document.documentElement.dataset.theme;
      T.setTheme(event.matches ? 'light' : this.theme);
      this.refresh();
      this.path.drawNow();
    });
    T.el('play').addEventListener('click', () => this.play());
    T.el('when').addEventListener('input', (event) => {
      const span = run.t[run.n - 1] - run.t[0];
      state.set(T.nearestIndex(run.t, run.t[0] + Number(event.target.value) / 1000 * span), 'play');
    });
    const go = (row) => state.set(row.dataset.go !== undefined ? Number(row.dataset.go) : T.nearestIndex(run.t, Number(row.dataset.time)), 'table');
    document.addEventListener('click', (event) => { const row = event.target.closest('tr.go'); if (row) go(row); });
    this.go = go;
  }

  chips() {
    T.el('chips').innerHTML = this.curves.available().map((q) => `<button data-key="${q.key}" class="${this.curves.shown.has(q.key) ? 'on' : ''}" aria-pressed="${this.curves.shown.has(q.key)}">${q.name}</button>`).join('');
  }

  play() {
    this.isPlaying = !this.isPlaying;
    T.el('play').textContent = this.isPlaying ? '❚❚' : '▶';
    if (!this.isPlaying) return;
    const run = this.state.runs[0];
    if (this.state.index >= run.n - 1) this.state.set(0, 'play');
    let last = performance.now();
    let now = run.t[this.state.index];
    const step = (clock) => {
      if (!this.isPlaying) return;
      now += (clock - last) / 1000 * Number(T.el('speed').value);
      last = clock;
      this.state.set(T.indexAt(run.t, now), 'play');
      if (this.state.index >= run.n - 1) this.play();
      else requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  keys() {
    document.addEventListener('keydown', (event) => {
      if (/INPUT|SELECT/.test(event.target.tagName) && event.target.id !== 'when') return;
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      const {state} = this;
      const worst = state.runs[0].worst;
      const by = (event.shiftKey ? 10 : 1);
      const acts = {
        ArrowRight: () => state.set(state.index + by, 'keys'), ArrowLeft: () => state.set(state.index - by, 'keys'),
        ' ': () => this.play(), '+': () => { this.path.zoom(1.4); this.scene.zoom(1.2); }, '-': () => { this.path.zoom(1 / 1.4); this.scene.zoom(1 / 1.2); },
        0: () => this.path.fit(), t: () => T.el('theme').click(), T: () => T.el('theme').click(),
        n: () => worst.length && state.set(worst[(worst.indexOf(state.index) + 1) % worst.length], 'keys'),
        Enter: () => { if (event.target.matches && event.target.matches('tr.go')) this.go(event.target); },
      };
      if (!acts[event.key] || (event.key === ' ' && event.target.tagName === 'BUTTON')) return;
      event.preventDefault();
      acts[event.key]();
    });
  }
};

T.start = async () => {
  try {
    const list = JSON.parse(T.el('runs').textContent);
    if (list[0].live) {
      const bytes = await T.inflate(list[0].data);
      if (list[0].text_bytes > 0) list[0].lines = T.linesOf(bytes.subarray(bytes.length - list[0].text_bytes));
      T.live(list[0]);
      return;
    }
    const runs = [];
    for (const [k, meta] of list.entries()) runs.push(await T.readRun(meta, k));
    T.page = new T.Page(runs);
    document.documentElement.dataset.ready = String(Math.round(performance.now()));
  } catch (error) {
    T.el('problem').hidden = false;
    T.el('problem').textContent = `This page cannot be shown: ${error.message}`;
    throw error;
  }
};
T.start();
