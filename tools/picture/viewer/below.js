// What stands below the view: tables, histograms, facts. All of it is there without WebGL, too.
import { make, ofSvg, brief, counted } from './dom.js';

const tableOf = (table, rows) => {
    const body = make('table', {}, make('tr', {}, ...table.columns.map((c, i) =>
        make('th', typeof table.rows[0]?.cells[i] === 'number' ? { className: 'number' } : {}, c))));
    for (const row of table.rows) {
        const made = make('tr', {}, ...row.cells.map((cell) =>
            make('td', typeof cell === 'number' ? { className: 'number' } : {},
                typeof cell === 'number' ? cell.toLocaleString('en', { maximumSignificantDigits: 7 }) : cell)));
        if (row.box) {
            made.dataset.row = rows.length;
            made.tabIndex = 0;
            rows.push({ element: made, box: row.box });
        }
        body.append(made);
    }
    const hint = table.rows.some((r) => r.box) ? 'Click a row to fly to it. ' : '';
    return [make('h2', {}, table.title), make('div', { className: 'wide' }, body),
        make('p', { className: 'note' }, hint + (table.note ?? ''))];
};

const histogramOf = ({ title, low, high, counts, marks, note, logarithmic }, unit) => {
    const [w, h, foot] = [640, 150, 34], most = Math.max(...counts, 1), bar = w / counts.length;
    const place = (value) => {
        const share = logarithmic ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low || 1);
        return w * Math.min(Math.max(share, 0), 1);
    };
    const end = (i) => logarithmic ? low * (high / low) ** (i / counts.length) : low + (high - low) * i / counts.length;
    const picture = ofSvg('svg', { viewBox: `-30 -22 ${w + 60} ${h + foot + 22}`, class: 'histogram', role: 'img' });
    counts.forEach((count, i) => {
        const tall = count ? Math.max(1, h * count / most) : 0;
        picture.append(ofSvg('rect', { x: i * bar, width: Math.max(bar - 1, 0.5), y: h - tall, height: tall },
            ofSvg('title', {}, `${brief(end(i))} to ${brief(end(i + 1))}${unit}: ${count.toLocaleString('en')}`)));
    });
    picture.append(ofSvg('line', { x1: 0, x2: w, y1: h, y2: h, class: 'axis' }));
    for (const at of [0, 0.25, 0.5, 0.75, 1])
        picture.append(ofSvg('text', { x: w * at, y: h + 16, 'text-anchor': 'middle' }, brief(end(at * counts.length))));
    for (const mark of marks) {
        const x = place(mark.at);
        picture.append(ofSvg('line', { x1: x, x2: x, y1: -6, y2: h, class: 'mark' }),
            ofSvg('text', { x, y: -9, 'text-anchor': x < 80 ? 'start' : x > w - 80 ? 'end' : 'middle', class: 'mark' },
                mark.text));
    }
    const words = counted(counts.reduce((a, b) => a + b, 0), 'value', 'values');
    return [make('h2', {}, title), picture, make('p', { className: 'note' }, `${words}${unit && ', in' + unit}. ${note ?? ''}`)];
};

/// Fills `place`, and returns the rows that one can fly to.
export const showBelow = (place, scene) => {
    const rows = [], unit = scene.unit_name ? ' ' + scene.unit_name : '';
    for (const histogram of scene.histograms) place.append(...histogramOf(histogram, unit));
    for (const table of scene.tables) place.append(...tableOf(table, rows));
    place.append(make('h2', {}, 'Inputs and settings'), make('div', { className: 'facts' }, make('table', {},
        ...scene.facts.map(([name, value]) =>
            make('tr', {}, make('td', {}, name), make('td', { className: 'text' }, value))))));
    return rows;
};
