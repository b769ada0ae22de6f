'use strict';
(() => {
  const data = JSON.parse(document.getElementById('plots').textContent);
  const AXES = ['x', 'y', 'z'];
  // Middle tones: they read on white, on black and on paper.
  const COLOUR = {x: '#2b7fc4', y: '#c9641f', z: '#23966a', soft: '#7a8591', refused: '#d6343f',
    accepted: '#23966a', learned: '#2b7fc4', factory: '#b07d1a'};
  const SHADE = {tone: 'rgba(130,80,223,0.20)', music: 'rgba(190,80,223,0.20)',
    sweep: 'rgba(90,80,223,0.20)', load: 'rgba(214,60,60,0.13)', move: 'rgba(214,130,20,0.22)',
    off: 'rgba(120,130,140,0.35)'};
  const SHAPES = {
    dot: (c, r) => { c.arc(0, 0, r, 0, 7); c.fill(); },
    circle: (c, r) => { c.arc(0, 0, r, 0, 7); c.stroke(); },
    square: (c, r) => { c.strokeRect(-r, -r, 2 * r, 2 * r); },
    diamond: (c, r) => {
      c.moveTo(0, -r); c.lineTo(r, 0); c.lineTo(0, r); c.lineTo(-r, 0); c.fill();
    },
    triangle: (c, r) => { c.moveTo(0, -r); c.lineTo(r, r); c.lineTo(-r, r); c.fill(); },
    cross: (c, r) => {
      c.moveTo(-r, -r); c.lineTo(r, r); c.moveTo(r, -r); c.lineTo(-r, r); c.stroke();
    },
  };
  const DASHES = {dashed: [7, 4], dotted: [2, 3]};
  const graphs = [];  // {graph, div}: all of them

  function mark(context, shape, colour, size) {
    context.save();
    context.beginPath();
    context.fillStyle = context.strokeStyle = colour;
    context.lineWidth = 1.7;
    SHAPES[shape](context, size);
    context.restore();
  }

  function make(tag, attributes, ...children) {
    const element = Object.assign(document.createElement(tag), attributes);
    element.append(...children);
    return element;
  }

  function keyOfMark(name, shape, colour, size) {
    const canvas = make('canvas', {width: 32, height: 32, style: 'width:16px;height:16px'});
    const context = canvas.getContext('2d');
    context.setTransform(2, 0, 0, 2, 16, 16);
    mark(context, shape, colour, Math.max(size, 2.5));
    return make('span', {className: 'mark'}, canvas, name);
  }

  function keyOfLine(name, colour, dash) {
    const canvas = make('canvas', {width: 52, height: 32, style: 'width:26px;height:16px'});
    const context = canvas.getContext('2d');
    context.setTransform(2, 0, 0, 2, 0, 16);
    context.strokeStyle = colour;
    context.lineWidth = 2;
    context.setLineDash(DASHES[dash] || []);
    context.beginPath();
    context.moveTo(0, 0);
    context.lineTo(26, 0);
    context.stroke();
    return make('span', {className: 'mark'}, canvas, name);
  }

  function range(values, share) {
    const known = values.filter(Number.isFinite);
    if (!known.length) return null;
    const low = Math.min(...known), high = Math.max(...known);
    const pad = Math.max((high - low) * share, 1e-3 * Math.abs(low), 1e-3 * Math.abs(high), 1e-6);
    return [low - pad, high + pad];
  }

  /** The title line above a plot: name, what the pointer is at, buttons. */
  function head(div, title) {
    const output = make('output', {});
    const line = make('div', {className: 'plot-title'}, make('b', {}, title), output);
    div.before(line);
    return {line, output};
  }

  function draw(div, rows, options) {
    const graph = new Dygraph(div, rows, Object.assign({
      legend: 'never', pixelRatio: Math.max(2, window.devicePixelRatio || 1), labelsKMB: false,
      gridLineColor: 'rgba(128,140,150,0.28)', axisLineColor: COLOUR.soft, axisLabelFontSize: 14,
      xLabelHeight: 18, yLabelWidth: 18, highlightSeriesBackgroundAlpha: 1, animatedZooms: false,
      digitsAfterDecimal: 3,
    }, options));
    graphs.push({graph, div});
    return graph;
  }

  /** Rows for Dygraph of all points that have a place, and the text of each. */
  function arranged(series) {
    const points = series.flatMap((s, i) => s.points.map(p => ({p, i})))
      .filter(({p}) => Number.isFinite(p.x) && Number.isFinite(p.y))
      .sort((a, b) => a.p.x - b.p.x);
    const fit = range(points.filter(({i}) => series[i].fit).map(({p}) => p.y), 0.12);
    return {
      rows: points.map(({p, i}) => [p.x, ...series.map((s, k) => k === i ? p.y : null)]),
      texts: points.map(({p}) => p.text),
      fit,
      beyond: points.filter(({p}) => fit && (p.y < fit[0] || p.y > fit[1])).length,
      xs: range(points.map(({p}) => p.x), 0.03),
    };
  }

  /** Draws a series' marks and counts them. */
  function marker(s, count) {
    const at = (factor, counted) => (g, name, context, x, y) => {
      context.save();
      context.translate(x, y);
      mark(context, s.shape, s.colour, s.size * factor);
      context.restore();
      if (counted) count[s.name] = (count[s.name] || 0) + 1;
    };
    return {drawPointCallback: at(1, true), drawHighlightPointCallback: at(1.6, false)};
  }

  /**
   * Marks by series {name, shape, colour, size, fit, points: [{x, y, text}]}. Each view {name,
   * ylabel, series()} shows the same series; a picture shows all points of those that `fit`, and
   * a button those beyond it too.
   */
  function scatter(id, title, xlabel, views) {
    const div = document.getElementById(id);
    const {line, output} = head(div, title);
    let view = 0, all = false;
    const series = views[0].series();
    let now = arranged(series);
    if (!now.rows.length) { line.remove(); div.remove(); return; }
    const count = {};
    const ranges = () => ({valueRange: all ? null : now.fit, dateWindow: now.xs});
    const graph = draw(div, now.rows, {
      labels: [xlabel, ...series.map(s => s.name)], colors: series.map(s => s.colour),
      series: Object.fromEntries(series.map(s => [s.name, marker(s, count)])), drawPoints: true,
      strokeWidth: 0, xlabel, ylabel: views[0].ylabel, ...ranges(),
      highlightSeriesOpts: {strokeWidth: 0},
      axes: {x: {valueFormatter: String, pixelsPerLabel: 70}, y: {axisLabelWidth: 60}},
      underlayCallback: () => { Object.keys(count).forEach(name => delete count[name]); },
      drawCallback: () => { div.dataset.marks = JSON.stringify(count); },
      highlightCallback: (event, x, points, row) => { output.textContent = now.texts[row]; },
      unhighlightCallback: () => { output.textContent = ''; },
    });
    const widen = make('button', {type: 'button'}), turn = make('button', {type: 'button'});
    const show = () => {
      graph.updateOptions({file: now.rows, ylabel: views[view].ylabel, ...ranges()});
      label();
    };
    const label = () => {
      widen.hidden = !now.beyond;
      widen.textContent = all ? 'fit the offsets' : `show ${now.beyond} beyond`;
      turn.textContent = `as ${views[1 - view]?.name}`;
    };
    widen.onclick = () => { all = !all; show(); };
    turn.onclick = () => { view = 1 - view; now = arranged(views[view].series()); show(); };
    label();
    line.append(widen);
    if (views.length > 1) line.append(turn);
  }

  /** Lines over time {name, colour, dash}; `fit`: the first picture's range of values. */
  function lines(id, title, ylabel, series, rows, fit) {
    const div = document.getElementById(id);
    const {line, output} = head(div, title);
    line.insertBefore(make('span', {}, ...series.map(s => keyOfLine(s.name, s.colour, s.dash))),
      output);
    if (!rows.length) { line.remove(); div.remove(); return null; }
    const bySeries = {};
    for (const s of series) bySeries[s.name] = {strokePattern: DASHES[s.dash] || null};
    const graph = draw(div, rows, {
      labels: ['t', ...series.map(s => s.name)], colors: series.map(s => s.colour),
      series: bySeries, strokeWidth: 1.4, xlabel: 't [s]', ylabel, valueRange: fit,
      dateWindow: [0, data.duration_s], axes: {x: {pixelsPerLabel: 70}, y: {axisLabelWidth: 60}},
      underlayCallback: shade,
      highlightCallback: (event, x, points) => {
        output.textContent = `t = ${x.toFixed(1)} s: ` + points.filter(p => p.yval !== null)
          .map(p => `${p.name} ${p.yval.toFixed(p.name.includes('mdps') ? 1 : 3)}`).join(', ');
      },
      unhighlightCallback: () => { output.textContent = ''; },
    });
    div.dataset.rows = rows.length;
    return graph;
  }

  function shade(context, area, graph) {
    context.canvas.closest('.plot').dataset.window = graph.xAxisRange().map(Math.round).join(' ');
    context.save();
    context.font = '11px sans-serif';
    for (const s of [...data.loads, ...data.stimuli]) {
      const left = graph.toDomXCoord(s.from_s), right = graph.toDomXCoord(s.to_s);
      const from = Math.max(left, area.x), to = Math.min(right, area.x + area.w);
      if (to < from) continue;
      context.fillStyle = SHADE[s.kind.split(' ')[0]] || SHADE.off;
      context.fillRect(from, area.y, Math.max(to - from, 1), area.h);
      context.fillStyle = COLOUR.soft;
      context.fillText(s.kind.replace('move ', ''), from + 2, area.y + 11);
    }
    context.restore();
  }

  function tie(tied) {
    let busy = false;
    for (const graph of tied) {
      graph.updateOptions({drawCallback: (g, initial) => {
        if (busy || initial) return;
        busy = true;
        for (const other of tied) {
          if (other !== g) other.updateOptions({dateWindow: g.xAxisRange()});
        }
        busy = false;
      }}, true);
    }
  }

  const stimulusText = i => i < 0 ? '' : `, during or after ${data.stimuli[i].kind}`;
  const readingText = r => `${r.name} (${r.code}) at ${r.t_s} s, ${r.degc} °C: ` +
    r.measured_mdps.map((v, a) => `${AXES[a]} ${v}`).join(', ') +
    ` mdps; value ${r.value}, limit ${r.limit}${r.axis ? `, axis ${r.axis}` : ''}` +
    (r.fate === 'refused' ? stimulusText(r.stimulus) || ', unexpected' : '');
  const entryText = (e, a) => `${e.origin} entry at ${e.degc} °C: ${e.zro_mdps[a]} mdps, ` +
    `sigma ${e.sigma_mdps} mdps, ${e.weight} reading${e.weight === 1 ? '' : 's'}`;

  function offsetSeries(a) {
    const entries = origin => data.entries.filter(e => e.origin === origin)
      .map(e => ({x: e.degc, y: e.zro_mdps[a], text: entryText(e, a)}));
    const readings = fate => data.readings
      .filter(r => r.fate === fate && r.measured_mdps.some(v => v !== 0))
      .map(r => ({x: r.degc, y: r.measured_mdps[a], text: readingText(r)}));
    return [
      {name: 'rig\'s raw mean, quiet second', shape: 'dot', colour: 'rgba(122,133,145,0.55)',
        size: 1.6, fit: true, points: data.cloud.map(c => ({x: c[0], y: c[a + 1] * 1e3,
          text: `raw mean ${(c[a + 1] * 1e3).toFixed(1)} mdps at ${c[0].toFixed(2)} °C`}))},
      {name: 'reading accepted', shape: 'circle', colour: COLOUR.accepted, size: 5,
        fit: true, points: readings('accepted')},
      {name: 'reading refused', shape: 'cross', colour: COLOUR.refused, size: 4.5,
        points: readings('refused')},
      {name: 'entry, factory', shape: 'square', colour: COLOUR.factory, size: 5.5, fit: true,
        points: entries('factory')},
      {name: 'entry, learned', shape: 'diamond', colour: COLOUR.learned, size: 4.5, fit: true,
        points: entries('learned')},
    ];
  }

  /** The rig's mean at a temperature [mdps]: a line through its quiet seconds within 1 °C. */
  function rigMean(a, degc) {
    const near = data.cloud.filter(c => Math.abs(c[0] - degc) <= 1);
    const n = near.length, ds = near.map(c => c[0] - degc);
    if (n < 10 || Math.min(...ds) > 0.3 || Math.max(...ds) < -0.3) return NaN;
    const sum = f => near.reduce((total, c, i) => total + f(ds[i], c[a + 1] * 1e3), 0);
    const md = sum(d => d) / n, my = sum((d, y) => y) / n;
    const sdd = sum(d => (d - md) ** 2), slope = sum((d, y) => (d - md) * (y - my)) / sdd;
    return sdd / n > 0.01 ? my - slope * md : my;  // on a soak a slope would only be noise
  }

  const deviationSeries = a => offsetSeries(a).map(s => ({...s, points: s.points.map(p => {
    const y = p.y - rigMean(a, p.x);
    return {x: p.x, y, text: `${y.toFixed(1)} mdps off the rig's mean; ${p.text}`};
  })}));

  AXES.forEach((axis, a) => scatter(`offset-${axis}`, `Axis ${axis}`, 'T [°C]', [
    {name: 'offset', ylabel: 'offset [mdps]', series: () => offsetSeries(a)},
    {name: 'deviation from the rig\'s mean', ylabel: 'deviation [mdps]',
      series: () => deviationSeries(a)}]));
  document.querySelector('#offsets .key').append(
    ...offsetSeries(0).map(s => keyOfMark(s.name, s.shape, s.colour, s.size)));

  const quiet = t => data.stimuli.every(s => t < s.from_s || t - 1 > s.to_s + 2);
  const rates = data.rates.filter(r => r[1] === null || quiet(r[0]));
  const axisLines = AXES.map((name, a) => ({name, colour: COLOUR[name],
    dash: [undefined, 'dashed', 'dotted'][a]}));
  tie([
    lines('temperatures', 'Temperatures', 'T [°C]',
      [{name: 'set point', colour: COLOUR.soft, dash: 'dashed'}, {name: 'plate', colour: COLOUR.y},
        {name: 'board', colour: COLOUR.x}], data.temperatures, null),
    lines('raw', 'Raw rate', 'rate [dps]', axisLines, data.rates.map(r => r.slice(0, 4)),
      range(rates.flatMap(r => r.slice(1, 4).filter(v => v !== null)), 0.25)),
    lines('corrected', 'Corrected rate', 'rate [mdps]', axisLines,
      data.rates.map(r => [r[0], ...r.slice(4).map(v => v === null ? null : v * 1e3)]),
      range(rates.flatMap(r => r.slice(4).filter(v => v !== null).map(v => v * 1e3)), 0.25)),
  ].filter(Boolean));
  document.querySelector('#time .key').append(...Object.keys(SHADE).map(kind => make('span',
    {className: 'mark'}, make('span', {className: 'swatch', style: `background:${SHADE[kind]}`}),
    kind === 'off' ? 'supply off' : kind)), 'Rates are scaled to the quiet seconds.');

  const toneShapes = ['triangle', 'square', 'diamond'];
  const toneSeries = () => AXES.map((axis, a) => ({name: axis, shape: toneShapes[a],
    colour: COLOUR[axis], size: 5.5, fit: true, points: data.tones.map(t => ({
      x: t.hz, y: t.shift_mdps[a] ?? NaN,
      text: `${t.band_hz ? `music about ${t.hz}` : t.hz} Hz, ${t.spl_db} dB SPL at ${t.degc} °C: ` +
        `${axis} ${t.shift_mdps[a]} mdps; ${t.decisions || 'no reading'}`}))}));
  scatter('tone-map', 'Rate made by sound', 'f [Hz]',
    [{name: 'shift', ylabel: 'shift [mdps]', series: toneSeries}]);
  document.querySelector('#tones .note').append(' ',
    ...AXES.map((axis, a) => keyOfMark(axis, toneShapes[a], COLOUR[axis], 5.5)));

  // A canvas keeps its pixels: paper shows it smaller instead of drawing it anew.
  const PAPER_PX = 700;  // A4 within its margins
  const fitPaper = () => graphs.forEach(({div}) => div.style.setProperty('--paper-zoom',
    Math.min(1, PAPER_PX / Math.max(div.clientWidth, 1))));
  window.addEventListener('resize', fitPaper);
  fitPaper();
})();
