// A run that is under way: rows come as server-sent events, and the page follows them.

T.live = (meta) => {
  meta.is_live = true;
  let columns = null;
  let isNew = false;
  const take = (event) => {
    const {names, rows} = JSON.parse(event.data);
    if (!columns) columns = Object.fromEntries(names.map((name) => [name, []]));
    for (const row of rows) names.forEach((name, k) => columns[name].push(row[k]));
    isNew = rows.length > 0;
  };
  const show = () => {
    if (!isNew || !columns || columns.t_s.length < 3) return;
    isNew = false;
    const c = {};
    for (const [name, values] of Object.entries(columns)) {
      c[name] = name === 't_s' ? Float64Array.from(values) : name === 'line' || name === 'segment' ? Int32Array.from(values) : Float32Array.from(values);
    }
    T.accelerate(c);
    const run = T.runOf(meta, 0, c);
    run.text = meta.lines;
    T.derive(run, c.rapid);
    if (T.page) T.page.update(run);
    else T.page = new T.Page([run]);
    document.documentElement.dataset.ready = document.documentElement.dataset.ready || String(Math.round(performance.now()));
    document.documentElement.dataset.rows = String(run.n);
  };
  const source = new EventSource('events');
  source.onmessage = take;
  const timer = setInterval(show, 250);
  const end = (text) => {
    source.close();
    clearInterval(timer);
    show();
    meta.live = false;
    if (T.page) T.header(T.page.state);
    T.el('notice').hidden = false;
    T.el('notice').textContent = text;
    document.documentElement.dataset.ended = '1';
  };
  source.addEventListener('end', () => end('The run has ended. report.html in the folder of its results has every row and the figures of the whole run.'));
  source.onerror = () => { if (source.readyState === EventSource.CLOSED || document.documentElement.dataset.rows) end('The program that made the run is gone. What is shown is what came until then.'); };
  T.el('name').textContent = meta.name;
  T.el('notice').hidden = false;
  T.el('notice').textContent = 'Waiting for the first motion.';
};

// Size of the acceleration of the set points, which a trace does not have.
T.accelerate = (c) => {
  const {t_s: t, x_cmd_mm: x, y_cmd_mm: y} = c;
  const a = c.acceleration_mm_per_s2 = new Float32Array(t.length);
  for (let i = 1; i + 1 < t.length; ++i) {
    const h = t[i + 1] - t[i];
    if (Math.abs(t[i] - t[i - 1] - h) < 1e-6) a[i] = Math.hypot(x[i + 1] - 2 * x[i] + x[i - 1], y[i + 1] - 2 * y[i] + y[i - 1]) / (h * h);
  }
};
