// What a page shows in a browser is what trace.csv and summary.json say.
'use strict';
const assert = require('assert');
const fs = require('fs');
const path = require('path');
const {spawn} = require('child_process');
const {chromium} = require('playwright-core');

const [folder, executablePath, twin] = process.argv.slice(2);
const complaints = [];
let passed = 0;

const trace = (run) => {
  const [head, ...rows] = fs.readFileSync(path.join(folder, run, 'trace.csv'), 'utf8').trim().split('\n');
  const names = head.split(',');
  return rows.map((row) => Object.fromEntries(row.split(',').map((v, k) => [names[k], Number(v)])));
};
const summary = (run) => JSON.parse(fs.readFileSync(path.join(folder, run, 'summary.json'), 'utf8'));
const number = (text) => Number(text.replace(/\u202f/g, '').replace('−', '-').match(/-?[\d.]+/)[0]);

const open = async (browser, file, options = {}) => {
  const page = await browser.newPage({viewport: {width: 1280, height: 900}, ...options});
  const url = 'file://' + path.join(folder, file);
  page.on('console', (m) => { if (m.type() === 'error' || m.type() === 'warning') complaints.push(`${file}: ${m.text()}`); });
  page.on('pageerror', (e) => complaints.push(`${file}: ${e.message}`));
  page.on('request', (r) => { if (r.url() !== url && !/^(data|blob):/.test(r.url())) complaints.push(`${file}: asks for ${r.url()}`); });
  await page.goto(url);
  await page.waitForFunction(() => document.documentElement.dataset.ready, null, {timeout: 60000});
  return page;
};

const now = (page) => page.$$eval('[data-now]', (list) => Object.fromEntries(list.map((e) => [e.dataset.now, e.textContent])));

// What the page shows at its cursor is the row of the trace at that time.
const expectRow = async (page, rows) => {
  const shown = await now(page);
  const row = rows[Math.round(number(shown.t) / 0.001)];
  assert.ok(Math.abs(row.t_s - number(shown.t)) < 1e-6, `time ${shown.t}`);
  assert.ok(Math.abs(row.x_cmd_mm - number(shown.x)) < 6e-4, `x ${shown.x} ${row.x_cmd_mm}`);
  assert.ok(Math.abs(row.y_cmd_mm - number(shown.y)) < 6e-4, `y ${shown.y}`);
  assert.ok(Math.abs(row.contour_error_um - Math.abs(number(shown.e))) < 1.1e-3, `error ${shown.e} ${row.contour_error_um}`);
  assert.ok(Math.abs(row.x_tracking_error_um - number(shown.ex)) < 0.011, `tracking ${shown.ex}`);
  assert.ok(Math.abs(row.feedrate_mm_per_s - number(shown.f)) < 6e-3, `feedrate ${shown.f}`);
  assert.strictEqual(row.line, number(shown.line));
  return row;
};

const test = async (name, body) => {
  try {
    await body();
    ++passed;
    console.log(`ok - ${name}`);
  } catch (error) {
    console.log(`FAILED - ${name}: ${error.stack}`);
    process.exitCode = 1;
  }
};

(async () => {
  const browser = await chromium.launch({executablePath, args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader']});
  const rows = trace('all');
  const facts = summary('all');
  const page = await open(browser, 'all/report.html', {colorScheme: 'light'});

  await test('key figures are those of summary.json', async () => {
    const text = await page.textContent('#keys');
    assert.ok(text.includes(facts.machining_time_s.toFixed(3)), text);
    const errors = await page.$$eval('#errors tbody tr', (list) => list.map((r) => [...r.cells].map((c) => c.textContent)));
    const row = errors.find((r) => r[0] === 'contour error, table');
    assert.ok(Math.abs(number(row[1]) - facts.table_contour_error_um.max) < 6e-4);
    assert.ok(Math.abs(number(row[2]) - facts.table_contour_error_um.rms) < 6e-4);
    assert.ok(Math.abs(number(row[3]) - facts.maxima.table_contour_error_max_um.t_s) < 6e-4);
    assert.strictEqual(number(row[4]), facts.maxima.table_contour_error_max_um.line);
  });

  await test('a click on the largest error goes to its place', async () => {
    const most = facts.cutting.contour_error_um.max;
    await page.click('#worst tbody tr:nth-child(2)');
    await page.click('#worst tbody tr:nth-child(1)');
    const row = await expectRow(page, rows);
    assert.ok(Math.abs(row.contour_error_um - most) < 1.1e-3, `${row.contour_error_um} ${most}`);
    assert.ok(Math.abs(row.t_s - facts.maxima.cutting_contour_error_max_um.t_s) < 1e-6);
    assert.strictEqual(await page.textContent('.lines p.on b'), String(row.line));
  });

  await test('hovering over the path shows the row there', async () => {
    const row = rows[Math.floor(rows.length / 2)];
    await page.$eval('#path', (e) => e.scrollIntoView());
    const [x, y] = await page.evaluate(([px, py]) => {
      const box = document.getElementById('path').getBoundingClientRect();
      return [box.left + T.page.path.sx(px), box.top + T.page.path.sy(py)];
    }, [row.x_cmd_mm, row.y_cmd_mm]);
    await page.mouse.move(x, y);
    const at = await expectRow(page, rows);
    assert.ok(Math.hypot(at.x_cmd_mm - row.x_cmd_mm, at.y_cmd_mm - row.y_cmd_mm) < 0.3);
    assert.ok((await page.textContent('#tip')).includes(`line ${at.line}`));
  });

  await test('hovering over a curve moves the cursor, and the curves tell its values', async () => {
    const over = page.locator('.plot[data-key="error"] .u-over');
    await over.scrollIntoViewIfNeeded();
    const box = await over.boundingBox();
    await page.mouse.move(box.x + 0.25 * box.width, box.y + 20);
    const row = await expectRow(page, rows);
    assert.ok(Math.abs(row.t_s - 0.25 * rows[rows.length - 1].t_s) < 0.01 * rows[rows.length - 1].t_s, `${row.t_s}`);
    const shown = await page.$$eval('.plot[data-key="error"] output', (list) => list.map((o) => o.textContent));
    assert.ok(Math.abs(number(shown[0]) - row.contour_error_signed_um) < 6e-3, `${shown[0]}`);
  });

  await test('dragging on a curve zooms all, a double click shows all again', async () => {
    const over = page.locator('.plot[data-key="feed"] .u-over');
    const box = await over.boundingBox();
    await page.mouse.move(box.x + 100, box.y + 30);
    await page.mouse.down();
    await page.mouse.move(box.x + 300, box.y + 30, {steps: 4});
    await page.mouse.up();
    const spans = await page.evaluate(() => T.page.curves.charts.map((c) => c.plot.scales.x.max - c.plot.scales.x.min));
    const share = 200 / box.width * rows[rows.length - 1].t_s;
    spans.forEach((span) => assert.ok(Math.abs(span - share) < 0.03 * share, `${span} ${share}`));
    await page.mouse.dblclick(box.x + 200, box.y + 30);
    assert.ok(await page.evaluate(() => T.page.curves.range === null));
  });

  await test('a click on a line of the program goes there', async () => {
    await page.$eval('#lines', (e) => { e.scrollTop = 0; });
    await page.click('.lines p[data-line="6"]');
    const row = await expectRow(page, rows);
    assert.strictEqual(row.line, 6);
    assert.ok((await page.textContent('.lines p.on')).includes('G01 Y30'));
  });

  await test('arrow keys step by rows', async () => {
    const before = await expectRow(page, rows);
    await page.keyboard.press('ArrowRight');
    const after = await expectRow(page, rows);
    assert.ok(Math.abs(after.t_s - before.t_s - 0.001) < 1e-9);
  });

  await test('every colour, the magnified error and space can be chosen', async () => {
    for (const key of await page.$$eval('#colour option', (list) => list.map((o) => o.value))) await page.selectOption('#colour', key);
    await page.selectOption('#magnify', '500');
    await page.screenshot({path: path.join(folder, 'magnified.png'), fullPage: true});
    await page.selectOption('#magnify', '0');
    await page.click('#dimension [data-v="3"]');
    const colours = await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => {
      T.page.scene.draw();
      const gl = T.page.scene.gl;
      if (!gl) { resolve(-1); return; }
      const [w, h] = [gl.drawingBufferWidth, gl.drawingBufferHeight];
      const pixels = new Uint8Array(4 * w * h);
      gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
      resolve(new Set(new Uint32Array(pixels.buffer)).size);
    })));
    assert.ok(colours === -1 || colours > 10, `${colours} colours in space`);
    await page.screenshot({path: path.join(folder, 'space.png'), fullPage: true});
    await page.click('#dimension [data-v="2"]');
  });

  await test('the page is whole at 400 px, in the dark and in print', async () => {
    const small = await open(browser, 'all/report.html', {viewport: {width: 400, height: 800}, colorScheme: 'dark', hasTouch: true});
    assert.ok(await small.evaluate(() => document.documentElement.scrollWidth) <= 400);
    await small.screenshot({path: path.join(folder, 'small_dark.png'), fullPage: true});
    await small.emulateMedia({media: 'print'});
    await small.screenshot({path: path.join(folder, 'print.png'), fullPage: true});
    await small.close();
  });

  await test('two runs are over each other, and what differs is listed', async () => {
    const both = await open(browser, 'both.html');
    const differ = await both.$$eval('#differ tbody tr', (list) => list.map((r) => [...r.cells].map((c) => c.textContent)));
    assert.deepStrictEqual(differ.map((r) => r[0]), ['servo.x.kp_per_s']);
    assert.strictEqual(number(differ[0][2]), 200);
    const errors = await both.$$eval('#errors tbody tr', (list) => list.map((r) => [...r.cells].map((c) => c.textContent)));
    const row = errors.find((r) => r[0] === 'tracking error, x');
    assert.ok(Math.abs(number(row[1]) - facts.tracking_error_um.x.max) < 6e-4);
    assert.ok(Math.abs(number(row[3]) - summary('soft').tracking_error_um.x.max) < 6e-4);
    await both.check('#differences');
    const lines = await both.evaluate(() => T.page.curves.charts.find((c) => c.q.key === 'track').lines.length);
    assert.strictEqual(lines, 2);
    await both.screenshot({path: path.join(folder, 'both.png'), fullPage: true});
    await both.close();
  });

  await test('a plan and a run that ended early say what they are', async () => {
    const plan = await open(browser, 'plan/report.html');
    assert.ok((await plan.textContent('#badges')).includes('plan'));
    await plan.close();
    const failed = await open(browser, 'failed/report.html');
    assert.ok((await failed.textContent('#badges')).includes('ended early'));
    assert.ok((await failed.textContent('#notice')).includes('tracking error'));
    await failed.screenshot({path: path.join(folder, 'failed.png'), fullPage: true});
    await failed.close();
  });

  await test('a run on the wall clock is seen while it goes on', async () => {
    const child = spawn(twin, ['run', 'part.nc', '--out', 'live', '--realtime', '--view', '0', '--feedrate-mm-per-min', '1200', '--no-plots', '--quiet'], {cwd: folder});
    let said = '';
    child.stderr.on('data', (text) => { said += text; });
    const ended = new Promise((resolve) => { child.on('exit', resolve); });
    while (!/http:\S+/.test(said)) await new Promise((resolve) => { setTimeout(resolve, 20); });
    const address = said.match(/http:\S+/)[0];
    const live = await browser.newPage({viewport: {width: 1280, height: 900}});
    live.on('pageerror', (e) => complaints.push(`live: ${e.message}`));
    assert.strictEqual((await live.request.get(address.replace(/[0-9a-f]{32}/, '0'.repeat(32)))).status(), 404);
    assert.strictEqual((await live.request.post(address)).status(), 404);
    await live.goto(address);
    await live.waitForFunction(() => Number(document.documentElement.dataset.rows) > 60, null, {timeout: 20000});
    assert.ok((await live.textContent('#badges')).includes('live'));
    await live.screenshot({path: path.join(folder, 'live.png'), fullPage: true});
    const before = Number(await live.evaluate(() => document.documentElement.dataset.rows));
    await live.waitForFunction(() => document.documentElement.dataset.ended, null, {timeout: 20000});
    assert.strictEqual(await ended, 0);
    const shown = await live.evaluate(() => ({n: T.page.state.runs[0].n, t: [...T.page.state.runs[0].t], x: [...T.page.state.runs[0].x]}));
    assert.ok(shown.n >= before);  // all of it, where the picture took longer than the run
    const all = trace('live');
    assert.ok(Math.abs(shown.n - all.length / 10) < 0.02 * shown.n, `${shown.n} of ${all.length}`);
    for (let i = 0; i < shown.n; i += 20) {
      const row = all[Math.round(shown.t[i] / 0.001)];
      assert.ok(Math.abs(row.x_cmd_mm - shown.x[i]) < 1e-4);
    }
    assert.ok((await live.textContent('#notice')).includes('has ended'));
    await live.close();
  });

  await test('no page complains or asks for anything', async () => { assert.deepStrictEqual(complaints, []); });
  await page.screenshot({path: path.join(folder, 'page.png'), fullPage: true});
  await browser.close();
  console.log(`${passed} passed, ${process.exitCode ? 'some' : 0} failed`);
})().catch((error) => { console.error(error); process.exit(1); });
