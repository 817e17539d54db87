// The page: reads the scene, shows it, and does what hands and switches ask for.
// Asks nothing of any network.
import { readScene, hitOfFace, valueAt, labelsOf, noValue } from './data.js';
import { Camera, boxThatMatters, views } from './camera.js';
import { Renderer } from './renderer.js';
import { addControls, markMapped, rampOfMap, variantsOf, leftOut, keys } from './panel.js';
import { showBelow } from './below.js';
import { listen } from './hands.js';
import { make, rgbOf, rounded } from './dom.js';
import { sub, length } from './vector.js';

const started = performance.now();
const textOf = (id) => document.getElementById(id).textContent;
const box = document.getElementById('view');
const scene = readScene(textOf('scene'), textOf('geometry'));
const unit = scene.unit_name ? ' ' + scene.unit_name : '';
scene.say = (value) => rounded(value) + unit;
const rows = showBelow(document.getElementById('below'), scene);

const show = (canvas, renderer) => {
    addControls(box, scene, rows);
    document.getElementById('below').prepend(make('p', { className: 'note' },
        'Drag to rotate, with the right button or Shift to pan; wheel to zoom; click for numbers; double-click to go there; ? for keys.' + leftOut(scene)));
    const find = (selector) => box.querySelector(selector);
    const isOn = (selector) => find(selector)?.checked ?? false;
    const camera = new Camera(scene.whole, scene.y_is_up);
    const ramp = rampOfMap(scene);
    scene.classes.forEach((c) => { c.rgb = rgbOf(c.color); });
    const state = { variant: scene.variants.length > 1 ? 'after' : scene.variants[0] ?? '', row: -1 };

    // ---- drawing ----
    const ratio = () => canvas.clientWidth / Math.max(canvas.clientHeight, 1) || 1;  // 1 of a hidden frame
    const panes = () => {
        const pane = (variant, left, width, from = left, to = left + width) => ({ variant, left, width, from, to,
            camera: camera.matrix(ratio() * width), eye: camera.axes().eye, ratio: ratio() * width });
        if (state.variant === 'side by side') return [pane('before', 0, 0.5), pane('after', 0.5, 0.5)];
        const wipe = Number(find('[data-wipe]')?.value);
        if (state.variant === 'wipe') return [pane('before', 0, 1, 0, wipe), pane('after', 0, 1, wipe, 1)];
        return [pane(state.variant, 0, 1)];
    };
    const look = () => {
        const axis = Number(find('[data-section]').value), way = isOn('[data-flip]') ? -1 : 1;
        const plane = [0, 0, 0, 1e9];
        if (axis) {
            const [low, high] = [scene.whole.low[axis - 1], scene.whole.high[axis - 1]];
            const share = (Number(find('[data-depth]').value) + 1) / 2;
            plane[axis - 1] = way;
            plane[3] = way * (low + (high - low) * share);
        }
        const { map } = scene;
        const band = map?.band && isOn('[data-band]') ? map.band.map((v) => (v - map.low) / (map.high - map.low || 1)) : [9, 8];
        return { plane, cut: axis > 0, glass: isOn('[data-glass]'), edges: isOn('[data-edges]'), mapped: isOn('[data-map]'),
            band, inBand: [0.498, 0.788, 0.498] };
    };
    const labels = labelsOf(scene);
    const tags = make('div', { className: 'tags' });
    box.append(tags);
    const placeLabels = () => {
        const wanted = find('[data-labels]') ? isOn('[data-labels]') : false, taken = [], made = [];
        const [w, h] = [canvas.clientWidth, canvas.clientHeight];
        for (const pane of wanted ? panes() : [])
            for (const { at, text, class: kind, variant } of labels) {
                if (!scene.classes[kind].shown || variant && variant !== pane.variant) continue;
                const m = pane.camera, [X, Y, , W] = [0, 1, 2, 3].map((i) =>
                    m[i] * at[0] + m[4 + i] * at[1] + m[8 + i] * at[2] + m[12 + i]);
                const x = (pane.left + pane.width * (X / W + 1) / 2) * w, y = (1 - Y / W) / 2 * h;
                if (!(W > 0) || x < pane.from * w || x > pane.to * w || y < 0 || y > h) continue;
                const wide = 7 * text.length + 14;
                if (taken.some((t) => Math.abs(t.x - x) < (t.wide + wide) / 2 && Math.abs(t.y - y) < 20)) continue;
                taken.push({ x, y, wide });
                made.push(make('span', { style: `left:${x.toFixed(1)}px;top:${y.toFixed(1)}px` }, text));
            }
        const both = panes();
        for (const pane of both.length > 1 ? both : [])
            made.push(make('span', { className: 'side', style: `left:${50 * (pane.from + pane.to)}%` }, pane.variant));
        tags.replaceChildren(...made);
    };
    const paint = () => renderer.paint([...scene.classes, ...new Array(255 - scene.classes.length).fill({ rgb: [0, 0, 0] }),
        { rgb: [255, 255, 255], shown: true }], ramp);
    const draw = () => {
        paint();
        renderer.draw(panes(), look());
        placeLabels();
    };
    let waiting = false;
    const redraw = () => {
        if (!waiting) requestAnimationFrame(() => {
            waiting = false;
            draw();
        });
        waiting = true;
    };

    // ---- what is at a pixel ----
    const contexts = scene.classes.filter((c) => c.context).length;
    const picked = find('.picked');
    const forget = () => {
        picked.replaceChildren();
        delete picked.dataset.number;
        state.hit = null;
        renderer.showOutline(null);
        redraw();
    };
    const decimals = Math.min(Math.max(Math.ceil(-Math.log10(scene.step)), 0), 20);
    const onGrid = (v) => Number(v.toFixed(decimals));  // no digit that the drawing does not have
    const lengthOf = (lines, a, b) => lines.text || scene.say(scene.lengthInFile(length(sub(b, a))));
    const say = ({ sort, item, row }, { eye, ray }) => {
        if (item.arrow) return item.name;
        const kind = scene.classes[item.kinds ? item.kinds[sort === 'face' ? 3 * row : row] : item.class];
        const number = item.numbers[row];
        const words = [kind.context && contexts < 2 ? '' : kind.name, item.groups?.[row] >= 0 ? `${item.group_word} ${item.groups[row]}` : ''];
        picked.dataset.number = number;
        let at = null, value = null;
        if (sort === 'face') {
            const hit = hitOfFace(item, row, eye, ray);
            renderer.showOutline(hit.corners);
            at = hit.point;
            state.hit = at;
            if (item.values) value = valueAt(item, row, hit.corners, at);
        } else if (sort === 'dot') {
            state.hit = at = [...item.positions.subarray(3 * row, 3 * row + 3)];
            if (item.values) value = item.values[row];
        } else {
            const [a, b] = [0, 3].map((k) => [...item.positions.subarray(6 * row + k, 6 * row + k + 3)]);
            words.push('length ' + lengthOf(item, a, b));
            at = a;
        }
        if (value !== null && value > noValue / 2) words.push(`${scene.map.name} ${rounded(scene.map.low + value * (scene.map.high - scene.map.low))}${unit}`);
        const bracket = words.filter(Boolean).join(', ');
        return `${item.word} ${number >= 0 ? number : 'new'}${item.name ? ' of ' + item.name : ''}` + (bracket ? ` (${bracket})` : '') +
            ` at ${scene.toFile(at).map(onGrid).join(', ')}`;
    };
    const pick = (x, y) => {
        forget();
        const share = x / canvas.clientWidth, pane = panes().find((p) => share >= p.from && share <= p.to);
        const scale = renderer.resize();
        paint();  // as switched by now, drawn or not
        const found = pane && renderer.pick(pane, look(), x * scale, y * scale);
        if (found) picked.append(say(found, camera.ray((share - pane.left) / pane.width, y / canvas.clientHeight, pane.ratio)));
        redraw();
    };

    // ---- flights ----
    const still = matchMedia('(prefers-reduced-motion: reduce)').matches;
    let flight = 0;
    const fly = (goal) => {
        const start = { target: camera.target, distance: camera.distance, turn: camera.turn, tilt: camera.tilt };
        const began = performance.now(), mine = ++flight;
        const step = (now) => {
            if (mine !== flight) return;
            const t = still ? 1 : Math.min(Math.max((now - began) / 450, 0), 1), s = t * t * (3 - 2 * t);
            if (goal.target) camera.target = start.target.map((v, i) => v + (goal.target[i] - v) * s);
            if (goal.distance) camera.distance = start.distance * (goal.distance / start.distance) ** s;
            if (goal.turn !== undefined) camera.turn = start.turn + (goal.turn - start.turn) * s;
            if (goal.tilt !== undefined) camera.tilt = start.tilt + (goal.tilt - start.tilt) * s;
            redraw();
            if (t < 1) requestAnimationFrame(step);
        };
        requestAnimationFrame(step);
    };
    const home = () => fly(camera.fit(scene.whole, ratio(), scene.samples));
    /// Seen from there, at the same distance from the same target.
    const turnTo = (name) => {
        const [turn, tilt] = views[name];
        fly({ turn: turn + 2 * Math.PI * Math.round((camera.turn - turn) / (2 * Math.PI)), tilt });
    };
    const visit = (index) => {
        if (!rows.length) return;
        rows[state.row]?.element.classList.remove('current');
        state.row = (index + rows.length) % rows.length;
        const { element, box: [low, high] } = rows[state.row];
        element.classList.add('current');
        const [a, b] = [scene.toView(low), scene.toView(high)];
        const radius = Math.max(length(sub(b, a)) / 2, 1e-5);
        fly({ target: a.map((v, i) => (v + b[i]) / 2), distance: 4 * radius });
    };

    // ---- switches ----
    const press = (selector) => {
        const input = find(selector);
        if (input) input.click();
        return Boolean(input);
    };
    const setVariant = (name) => {
        state.variant = name;
        camera.back = name === 'side by side' ? 1.6 : 1;
        box.querySelectorAll('[data-variant]').forEach((b) => b.classList.toggle('on', b.dataset.variant === name));
        find('.wipe').hidden = name !== 'wipe';
        redraw();
    };
    const setSection = (axis) => {
        find('[data-section]').value = axis;
        find('[data-depth]').disabled = !axis;
        redraw();
    };
    const help = () => {
        const open = find('.help');
        if (open) return open.remove();
        box.append(make('div', { className: 'help' }, make('table', {},
            ...keys.map(([key, what]) => make('tr', {}, make('td', {}, key), make('td', {}, what))))));
    };
    const dark = () => {
        const root = document.documentElement;
        const now = root.dataset.theme ?? (matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light');
        root.dataset.theme = now === 'dark' ? 'light' : 'dark';
        redraw();
    };
    box.addEventListener('change', ({ target }) => {
        if (target.dataset.class) scene.classes[target.dataset.class].shown = target.checked;
        if ('map' in target.dataset) markMapped(box, scene, target.checked);
        if ('up' in target.dataset) camera.yIsUp = target.checked;
        if ('section' in target.dataset) setSection(Number(target.value));
        redraw();
    });
    box.addEventListener('input', redraw);
    box.addEventListener('click', ({ target }) => {
        const { view, variant, home: all, next, dark: shade, help: asked } = target.dataset;
        if (view) turnTo(view);
        if (variant) setVariant(variant);
        if (all !== undefined) home();
        if (next !== undefined) visit(state.row + 1);
        if (shade !== undefined) dark();
        if (asked !== undefined) help();
    });
    rows.forEach(({ element }, i) => {
        element.addEventListener('click', () => visit(i));
        element.addEventListener('keydown', (e) => e.key === 'Enter' && visit(i));
    });
    const key = (name, shift) => {
        const order = ['oblique', 'front', 'back', 'left', 'right', 'top', 'bottom'];
        const arrow = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[name];
        const variants = variantsOf(scene), small = name.length === 1 ? name.toLowerCase() : name;
        const slide = (by) => {
            const depth = find('[data-depth]');
            depth.value = Number(depth.value) + by;
            redraw();
        };
        const actions = {
            f: home, n: () => visit(state.row + 1), p: () => visit(state.row - 1), d: dark, '?': help,
            '+': () => act.zoom(0.85), '=': () => act.zoom(0.85), '-': () => act.zoom(1 / 0.85),
            s: () => setSection((Number(find('[data-section]').value) + 1) % 4), '[': () => slide(-0.04), ']': () => slide(0.04),
            v: () => variants.length && setVariant(variants[(variants.indexOf(state.variant) + 1) % variants.length]),
            g: () => press('[data-glass]'), e: () => press('[data-edges]'), l: () => press('[data-labels]'),
            m: () => press('[data-map]'), Escape: () => {
                find('.help')?.remove();
                forget();
            },
        };
        if (arrow) shift ? act.pan(arrow[0] * 40, arrow[1] * 40) : act.turn(arrow[0] * -0.12, arrow[1] * -0.12);
        else if (name >= '0' && name <= '6' && name.length === 1) turnTo(order[name]);
        else if (actions[small]) actions[small]();
        else return false;
        return true;
    };
    const act = {
        key, pick,
        turn: (dx, dy) => { ++flight; camera.orbit(dx, dy); redraw(); },
        pan: (dx, dy) => { ++flight; camera.pan(dx, dy, canvas.clientHeight); redraw(); },
        zoom: (factor) => { ++flight; camera.zoom(factor); redraw(); },
    };
    listen(box, canvas, act);
    canvas.addEventListener('dblclick', () => state.hit && fly({ target: state.hit, distance: camera.distance / 2 }));
    const divider = find('.wipe');
    if (divider) divider.addEventListener('input', () => divider.style.setProperty('--at', find('[data-wipe]').value));

    const begin = () => {
        const first = boxThatMatters(scene);
        Object.assign(camera, camera.fit(first, ratio(), first === scene.whole ? scene.samples : undefined));
    };
    begin();
    new ResizeObserver(() => {
        if (!flight) begin();  // nobody has turned it yet; a frame may get its size late
        redraw();
    }).observe(canvas);
    const asked = /^#(?:region|row)=(\d+)$/.exec(location.hash);  // a page can be linked to at a row
    if (asked && rows[asked[1]]) visit(Number(asked[1]));
    draw();
    window.viewer = { scene, camera, draw, pick, pixels: () => renderer.pixels(), opened: performance.now() - started };
};

const canvas = make('canvas', { tabIndex: 0, 'aria-label': '3D view' });
box.append(canvas);
const renderer = new Renderer(canvas, scene);
if (renderer.gl) show(canvas, renderer);
else
    box.replaceChildren(make('p', { className: 'missing' }, 'This browser shows no 3D view (WebGL 2 is missing or ' +
        'switched off). The tables below are complete without it.'));
