'use strict';
(() => {
  const data = JSON.parse(document.getElementById('plots').textContent);
  const AXES = ['x', 'y', 'z'];
  // Middle tones: they read on white, on black and on paper.
  const COLOUR = {x: '#2b7fc4', y: '#c9641f', z: '#23966a', soft: '#7a8591', refused: '#d6343f',
    accepted: '#23966a', learned: '#2b7fc4', factory: '#b07d1a'};
  const SHADE = {tone: 'rgba(130,80,223,0.20)', move: 'rgba(214,130,20,0.22)',
    off: 'rgba(120,130,140,0.35)'};
  const SHAPES = {
    dot: (c, r) => { c.arc(0, 0, r, 0, 7); c.fill(); },
    circle: (c, r) => { c.arc(0, 0, r, 0, 7); c.stroke(); },
    square: (c, r) => { c.strokeRect(-r, -r, 2 * r, 2 * r); },
    diamond: (c, r) => {
      c.moveTo(0, -r); c.lineTo(r, 0); c.lineTo(0, r); c.lineTo(-r, 0); c.closePath(); c.fill();
    },
    triangle: (c, r) => { c.moveTo(0, -r); c.lineTo(r, r); c.lineTo(-r, r); c.closePath(); c.fill(); },
    cross: (c, r) => { c.moveTo(-r, -r); c.lineTo(r, r); c.moveTo(r, -r); c.lineTo(-r, r); c.stroke(); },
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
    const pad = Math.max((high - low) * share, 1e-3 * Math.max(Math.abs(low), Math.abs(high)), 1e-6);
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

  /**
   * Marks by series {name, shape, colour, size, points: [{x, y, text}]}. The first picture shows
   * all points of series that `fit`; the button shows those beyond it too.
   */
  function scatter(id, title, labels, series) {
    const div = document.getElementById(id);
    const {line, output} = head(div, title);
    const rows = [], texts = [];
    series.flatMap((s, i) => s.points.map(p => ({p, i})))
      .filter(({p}) => Number.isFinite(p.x) && Number.isFinite(p.y))
      .sort((a, b) => a.p.x - b.p.x)
      .forEach(({p, i}) => {
        const row = new Array(series.length + 1).fill(null);
        row[0] = p.x;
        row[i + 1] = p.y;
        rows.push(row);
        texts.push(p.text);
      });
    if (!rows.length) { line.remove(); div.remove(); return; }
    const fit = range(series.filter(s => s.fit).flatMap(s => s.points.map(p => p.y)), 0.12);
    const outside = fit ? rows.filter(r => r.slice(1).some(
      y => y !== null && (y < fit[0] || y > fit[1]))).length : 0;
    const xs = range(rows.map(r => r[0]), 0.03);
    let drawn = {};
    const bySeries = {};
    for (const s of series) {
      const one = (factor, count) => (g, name, context, x, y, colour, size, index) => {
        context.save();
        context.translate(x, y);
        mark(context, s.shape, s.colour, s.size * factor);
        context.restore();
        if (count) drawn[s.name] = (drawn[s.name] || 0) + 1;
      };
      bySeries[s.name] = {drawPointCallback: one(1, true), drawHighlightPointCallback: one(1.6)};
    }
    const graph = draw(div, rows, {
      labels: [labels.x, ...series.map(s => s.name)], series: bySeries, colors:
      series.map(s => s.colour), drawPoints: true, strokeWidth: 0, xlabel: labels.x, ylabel: labels.y,
      valueRange: fit, dateWindow: xs, highlightSeriesOpts: {strokeWidth: 0},
      axes: {x: {valueFormatter: String, pixelsPerLabel: 70}, y: {axisLabelWidth: 60}},
      underlayCallback: () => { drawn = {}; },
      drawCallback: () => { div.dataset.marks = JSON.stringify(drawn); },
      highlightCallback: (event, x, points, row, name) => { output.textContent = texts[row]; },
      unhighlightCallback: () => { output.textContent = ''; },
    });
    if (outside) {
      const button = make('button', {type: 'button', textContent: `show ${outside} beyond`});
      let all = false;
      button.onclick = () => {
        all = !all;
        button.textContent = all ? 'fit the offsets' : `show ${outside} beyond`;
        graph.updateOptions({valueRange: all ? null : fit, dateWindow: xs});
      };
      line.append(button);
    }
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
    for (const s of data.stimuli) {
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

  AXES.forEach((axis, a) => scatter(`offset-${axis}`, `Axis ${axis}`,
    {x: 'T [°C]', y: 'offset [mdps]'}, offsetSeries(a)));
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
  scatter('tone-map', 'Rate made by sound', {x: 'f [Hz]', y: 'shift [mdps]'},
    AXES.map((axis, a) => ({name: axis, shape: toneShapes[a], colour: COLOUR[axis], size: 5.5,
      fit: true, points: data.tones.map(t => ({x: t.hz, y: t.shift_mdps[a] ?? NaN,
        text: `${t.hz} Hz, ${t.spl_db} dB SPL at ${t.degc} °C: ${axis} ${t.shift_mdps[a]} mdps`}))})));
  document.querySelector('#tones .note').append(' ',
    ...AXES.map((axis, a) => keyOfMark(axis, toneShapes[a], COLOUR[axis], 5.5)));

  // A canvas keeps its pixels: paper shows it smaller instead of drawing it anew.
  const PAPER_PX = 700;  // A4 within its margins
  const fitPaper = () => graphs.forEach(({div}) => div.style.setProperty('--paper-zoom',
    Math.min(1, PAPER_PX / Math.max(div.clientWidth, 1))));
  window.addEventListener('resize', fitPaper);
  fitPaper();
})();
