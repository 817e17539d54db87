// The controls over the view: legend, views, variants, section, map.
import { make, brief, counted, rampOf } from './dom.js';
import { views } from './camera.js';

const check = (text, checked, data, ...before) => make('label', {},
    make('input', { type: 'checkbox', checked, data }), ...before, ' ' + text);

/// A class has a switch where something has its color.
const used = (scene) => {
    const there = new Set([...scene.lines.filter((l) => l.count).map((l) => l.class), ...scene.labels.map((l) => l.class)]);
    for (const { kinds } of [...scene.meshes, ...scene.dots]) for (const kind of kinds) there.add(kind);
    return there;
};

const legend = (scene) => {
    const there = used(scene);
    return scene.classes.map((c, i) => there.has(i) ? check(c.name + (c.count ? ` (${c.count})` : ''), c.shown, { class: i },
        make('span', { className: 'swatch', style: `background:${c.mapped ? `var(--map,${c.color})` : c.color}` })) : null);
};

/// Swatches of what the map colors have its colors, too.
export const markMapped = (box, { map }, on) => {
    if (map && on) box.style.setProperty('--map', rampOfScale(map));
    else box.style.removeProperty('--map');
};

const rampOfScale = (map) => `linear-gradient(90deg,${map.colors.join()})`;

const scaleOf = ({ map }, unit) => {
    if (!map) return null;
    const place = (value) => 100 * (value - map.low) / (map.high - map.low || 1);
    const bar = make('div', { className: 'scale', style: `background:${rampOfScale(map)}` });
    if (map.band) {
        const [low, high] = map.band.map((v) => Math.min(Math.max(place(v), 0), 100));
        bar.append(make('span', { className: 'band', style: `left:${low}%;width:${high - low}%` }));
    }
    const ends = [map.low, ...map.low < 0 && map.high > 0 ? [0] : [], map.high];
    return make('div', { className: 'map' }, check(map.name, true, { map: '' }), bar,
        make('div', { className: 'ends' }, ...ends.map((v) => make('span', {}, brief(v) + (v === ends.at(-1) ? unit : '')))),
        map.band ? check(`within the band ${brief(map.band[0])} to ${brief(map.band[1])}`, true, { band: '' },
            make('span', { className: 'swatch inband' })) : null);
};

const section = () => make('div', { className: 'section' },
    make('select', { title: 'section plane (S)', data: { section: '' } },
        ...['no section', 'cut x', 'cut y', 'cut z'].map((text, i) => make('option', { value: i }, text))),
    make('input', { type: 'range', min: -1, max: 1, step: 0.002, value: 0, disabled: true, data: { depth: '' } }),
    check('other side', false, { flip: '' }));

const buttons = (names, data, current) => make('div', { className: 'row' },
    ...names.map((name) => make('button', { type: 'button', className: name === current ? 'on' : '', data: { [data]: name } }, name)));

export const variantsOf = (scene) => scene.variants.length > 1 ? ['before', 'after', 'side by side', 'wipe'] : [];
export const rampOfMap = ({ map }) => map ? rampOf(map.colors) : [];

/// Adds the controls to `box`; `rows` are there to fly to.
export const addControls = (box, scene, rows) => {
    const unit = scene.unit_name ? ' ' + scene.unit_name : '';
    const faces = scene.meshes.length > 0, context = scene.classes.some((c) => c.context) && faces;
    const bar = make('div', { className: 'bar' }, ...legend(scene), scaleOf(scene, unit),
        make('div', { className: 'switches' },
            context ? check('see through', false, { glass: '' }) : null,
            faces ? check('edges', false, { edges: '' }) : null,
            scene.labels.length + scene.arrows.length || scene.lines.some((l) => l.labeled)
                ? check('labels', true, { labels: '' }) : null,
            check('y is up', scene.y_is_up, { up: '' })),
        scene.unit_name ? make('div', { className: 'unit' }, 'unit: ' + scene.unit_name) : null);
    const tools = make('div', { className: 'tools' }, buttons(Object.keys(views), 'view'),
        make('div', { className: 'row' },
            rows.length ? make('button', { type: 'button', data: { next: '' } }, 'next ' + (scene.place_word ?? 'place')) : null,
            make('button', { type: 'button', data: { home: '' } }, 'whole model'),
            make('button', { type: 'button', title: 'dark or light (D)', data: { dark: '' } }, '\u25d0'),
            make('button', { type: 'button', title: 'keys (?)', data: { help: '' } }, '?')),
        section());
    const variants = variantsOf(scene);
    markMapped(box, scene, true);
    box.append(bar, tools, make('div', { className: 'picked' }));
    if (!variants.length) return;
    box.append(make('div', { className: 'variants' }, buttons(variants, 'variant', 'after')),
        make('div', { className: 'wipe', hidden: true },
            make('input', { type: 'range', min: 0, max: 1, step: 0.001, value: 0.5, title: 'before | after', data: { wipe: '' } })));
};

export const leftOut = (scene) => {
    const parts = scene.left_out.map(({ count, one, many }) => counted(count, one, many));
    return parts.length ? ' Not drawn, to keep the page small: ' + parts.join(', ') + '.' : '';
};

export const keys = [['1 to 6', 'front, back, left, right, top, bottom'], ['0', 'oblique'], ['F', 'whole model'],
    ['N, P', 'next, previous row'], ['arrows', 'rotate; with Shift, pan'], ['+ -', 'zoom'], ['S', 'next section plane'],
    ['[ ]', 'move the section'], ['V', 'before, after, side by side, wipe'], ['G', 'see through'], ['E', 'edges'],
    ['L', 'labels'], ['M', 'colors of values'], ['D', 'dark or light'], ['Esc', 'close, clear the selection'], ['?', 'this list']];
