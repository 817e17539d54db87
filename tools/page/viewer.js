'use strict';
// The 3D view of a page: orbit, pan, zoom, classes on and off, flights to regions, picking.
// Reads what the tool has put into the page; asks nothing of any network.
(() => {
    const scene = JSON.parse(document.getElementById('scene').textContent);
    const box = document.getElementById('view');
    const canvas = box.querySelector('canvas');
    const gl = canvas.getContext('webgl2', { antialias: true, alpha: true });
    if (!gl) {
        box.innerHTML = '<p class="missing">This browser shows no 3D view (WebGL 2 is missing or ' +
            'switched off). The tables below are complete without it.</p>';
        return;
    }

    // ---- data: zigzag varints, each value relative to the one before in its stream ----
    const bytes = Uint8Array.from(atob(document.getElementById('geometry').textContent.trim()),
        (c) => c.charCodeAt(0));
    let at = 0;
    const next = () => {
        let value = 0, scale = 1, byte;
        do {
            byte = bytes[at++];
            value += (byte & 127) * scale;
            scale *= 128;
        } while (byte > 127);
        return value % 2 ? -(value + 1) / 2 : value / 2;
    };
    const unit = 2 / scene.steps;  // lattice to [-1, 1] along the longest side
    const half = scene.size.map((s) => s / 2);
    const readPoints = (count) => {
        const points = new Float32Array(3 * count);
        const last = [0, 0, 0];
        for (let i = 0; i < count; ++i)
            for (let axis = 0; axis < 3; ++axis) {
                last[axis] += next();
                points[3 * i + axis] = (last[axis] - half[axis]) * unit;
            }
        return points;
    };
    const corners = readPoints(scene.points);
    const positions = new Float32Array(9 * scene.faces);
    const kinds = new Uint8Array(3 * scene.faces);
    const numbers = new Float64Array(scene.faces);
    const regions = new Int32Array(scene.faces);
    for (let f = 0, corner = 0, number = 0; f < scene.faces; ++f) {
        for (let i = 0; i < 3; ++i) {
            corner += next();
            positions.set(corners.subarray(3 * corner, 3 * corner + 3), 9 * f + 3 * i);
        }
        number += next();
        numbers[f] = number;
        kinds.fill(next(), 3 * f, 3 * f + 3);
        regions[f] = kinds[3 * f] ? next() : -1;
    }
    const segments = readPoints(2 * scene.segments);

    // ---- programs ----
    const program = (vertex, fragment) => {
        const made = gl.createProgram();
        for (const [type, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
            const shader = gl.createShader(type);
            gl.shaderSource(shader, '#version 300 es\nprecision highp float;precision highp int;' + text);
            gl.compileShader(shader);
            gl.attachShader(made, shader);
        }
        gl.bindAttribLocation(made, 0, 'position');
        gl.bindAttribLocation(made, 1, 'kind');
        gl.linkProgram(made);
        const where = (name) => gl.getUniformLocation(made, name);
        return { made, where };
    };
    const faceProgram = program(
        `in vec3 position; in float kind; uniform mat4 camera; uniform vec3 eye; uniform bool shown[16];
         uniform vec3 colors[16]; out vec3 ray; flat out vec3 color; flat out int id; flat out int context;
         void main() {
             int k = int(kind);
             gl_Position = shown[k] ? camera * vec4(position, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
             ray = position - eye; color = colors[k]; id = gl_VertexID / 3; context = k == 0 ? 1 : 0;
         }`,
        `in vec3 ray; flat in vec3 color; flat in int id; flat in int context;
         uniform bool picking; uniform bool ghost; uniform bool glass; out vec4 pixel;
         void main() {
             bool sieve = int(gl_FragCoord.x) % 3 != 0 || int(gl_FragCoord.y) % 3 != 0;
             if (context == 1 && (ghost || glass && (picking || sieve))) discard;
             if (picking) {
                 int n = id + 1;
                 pixel = vec4(n & 255, n >> 8 & 255, n >> 16 & 255, 255) / 255.0;
                 return;
             }
             if (ghost) {
                 pixel = vec4(color, 0.3);
                 return;
             }
             vec3 normal = normalize(cross(dFdx(ray), dFdy(ray)));
             float light = 0.45 + 0.55 * abs(dot(normal, normalize(ray)));
             pixel = vec4(color * (gl_FrontFacing ? light : 0.72 * light), 1.0);
         }`);
    const lineProgram = program(
        'in vec3 position; uniform mat4 camera; void main() { gl_Position = camera * vec4(position, 1.0);' +
            'gl_Position.z -= 0.0004 * gl_Position.w; gl_PointSize = 4.0; }',
        'uniform vec4 tint; out vec4 pixel; void main() { pixel = tint; }');
    const upload = (attribute, data, size, type) => {
        gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
        gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
        gl.enableVertexAttribArray(attribute);
        gl.vertexAttribPointer(attribute, size, type, false, 0, 0);
    };
    const faceArray = gl.createVertexArray();
    gl.bindVertexArray(faceArray);
    upload(0, positions, 3, gl.FLOAT);
    upload(1, kinds, 1, gl.UNSIGNED_BYTE);
    const lineArray = gl.createVertexArray();
    gl.bindVertexArray(lineArray);
    upload(0, segments, 3, gl.FLOAT);

    // ---- camera ----
    const add = (a, b, s) => a.map((v, i) => v + b[i] * s);
    const sub = (a, b) => add(a, b, -1);
    const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    const unitVector = (a) => a.map((v) => v / Math.hypot(...a));
    const whole = Math.hypot(...scene.size) / scene.steps;  // half the diagonal
    const upSwitch = box.querySelector('[data-up]');
    const home = { target: [0, 0, 0], distance: 2.4 * Math.max(whole, 1e-6), turn: -0.6, tilt: 0.45 };
    const view = structuredClone(home);
    const axes = () => {
        const stand = ([x, y, z]) => upSwitch.checked ? [x, z, -y] : [x, y, z];
        const back = stand([Math.cos(view.tilt) * Math.sin(view.turn),
            -Math.cos(view.tilt) * Math.cos(view.turn), Math.sin(view.tilt)]);
        const right = stand([Math.cos(view.turn), Math.sin(view.turn), 0]);
        return { back, right, up: cross(back, right), eye: add(view.target, back, view.distance) };
    };
    const opening = Math.tan(0.35);
    const camera = () => {
        const { back, right, up, eye } = axes();
        const reach = Math.hypot(...view.target) + whole;
        const far = view.distance + 1.05 * reach;
        const near = Math.max(view.distance - 1.05 * reach, 0.002 * view.distance);
        const sx = canvas.height / canvas.width / opening, sy = 1 / opening;
        const a = (far + near) / (far - near), b = 2 * far * near / (far - near);
        const columns = [0, 1, 2].map((i) => [sx * right[i], sy * up[i], -a * back[i], -back[i]]);
        const depth = dot(back, eye);
        return new Float32Array([...columns.flat(), -sx * dot(right, eye), -sy * dot(up, eye),
            a * depth - b, depth]);
    };

    // ---- drawing ----
    const switches = [...box.querySelectorAll('[data-kind]')];
    const curveSwitch = box.querySelector('[data-curves]');
    const glassSwitch = box.querySelector('[data-glass]');
    gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    const drawFaces = (matrix, picking) => {
        gl.useProgram(faceProgram.made);
        gl.uniformMatrix4fv(faceProgram.where('camera'), false, matrix);
        gl.uniform3fv(faceProgram.where('eye'), axes().eye);
        const shown = new Array(16).fill(0);
        for (const s of switches) shown[s.dataset.kind] = s.checked ? 1 : 0;
        gl.uniform1iv(faceProgram.where('shown'), shown);
        const colors = scene.colors.flatMap((c) => [1, 3, 5].map((i) => parseInt(c.slice(i, i + 2), 16) / 255));
        gl.uniform3fv(faceProgram.where('colors'), colors);
        gl.uniform1i(faceProgram.where('picking'), picking ? 1 : 0);
        gl.uniform1i(faceProgram.where('glass'), glassSwitch.checked ? 1 : 0);
        gl.bindVertexArray(faceArray);
        gl.enable(gl.DEPTH_TEST);
        gl.uniform1i(faceProgram.where('ghost'), 0);
        gl.drawArrays(gl.TRIANGLES, 0, 3 * scene.faces);
        if (picking) return;
        gl.uniform1i(faceProgram.where('ghost'), 1);  // marked faces shine through what hides them
        gl.enable(gl.BLEND);
        gl.depthFunc(gl.GREATER);
        gl.depthMask(false);
        gl.drawArrays(gl.TRIANGLES, 0, 3 * scene.faces);
        gl.depthMask(true);
        gl.depthFunc(gl.LESS);
        gl.disable(gl.BLEND);
    };
    const drawCurves = (matrix) => {
        if (!curveSwitch.checked || !scene.segments) return;
        gl.useProgram(lineProgram.made);
        gl.uniformMatrix4fv(lineProgram.where('camera'), false, matrix);
        gl.bindVertexArray(lineArray);
        gl.enable(gl.BLEND);
        for (const hidden of [true, false]) {  // faintly through the model, fully in front of it
            gl[hidden ? 'disable' : 'enable'](gl.DEPTH_TEST);
            gl.uniform4f(lineProgram.where('tint'), 0.05, 0.05, 0.1, hidden ? 0.25 : 1);
            gl.drawArrays(gl.LINES, 0, 2 * scene.segments);
        }
        gl.disable(gl.BLEND);
    };
    let waiting = false;
    const draw = () => {
        waiting = false;
        const ratio = window.devicePixelRatio || 1;
        canvas.width = Math.max(1, Math.round(canvas.clientWidth * ratio));
        canvas.height = Math.max(1, Math.round(canvas.clientHeight * ratio));
        gl.viewport(0, 0, canvas.width, canvas.height);
        gl.clearColor(0, 0, 0, 0);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        const matrix = camera();
        drawFaces(matrix, false);
        drawCurves(matrix);
    };
    const redraw = () => {
        if (!waiting) requestAnimationFrame(draw);
        waiting = true;
    };

    // ---- picking: draw the face numbers, read one pixel ----
    const picked = box.querySelector('.picked');
    const toFile = (p) => p.map((v, i) => scene.low[i] + (v / unit + half[i]) * scene.step);
    const pick = (x, y) => {
        const ratio = canvas.width / canvas.clientWidth;
        const matrix = camera();
        gl.clearColor(0, 0, 0, 0);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        drawFaces(matrix, true);
        const pixel = new Uint8Array(4);
        gl.readPixels(Math.floor(x * ratio), canvas.height - 1 - Math.floor(y * ratio), 1, 1, gl.RGBA,
            gl.UNSIGNED_BYTE, pixel);
        redraw();
        const f = pixel[0] + 256 * pixel[1] + 65536 * pixel[2] - 1;
        picked.textContent = '';
        if (f < 0 || f >= scene.faces) return;
        const { back, right, up, eye } = axes();  // the ray through the pixel meets the face's plane
        const sideways = (2 * x / canvas.clientWidth - 1) * opening * canvas.width / canvas.height;
        const upwards = (1 - 2 * y / canvas.clientHeight) * opening;
        const ray = right.map((v, i) => v * sideways + up[i] * upwards - back[i]);
        const [a, b, c] = [0, 3, 6].map((i) => [...positions.subarray(9 * f + i, 9 * f + i + 3)]);
        const normal = cross(sub(b, a), sub(c, a));
        const share = dot(normal, sub(a, eye)) / dot(normal, ray);
        const hit = Number.isFinite(share) ? add(eye, ray, share) : a;
        const kind = kinds[3 * f];
        picked.textContent = `face ${numbers[f]}` + (kind ? ` (${scene.kinds[kind]}, region ${regions[f]})` : '') +
            ` at ${toFile(hit).map((v) => Number(v.toPrecision(7))).join(', ')}`;
    };

    // ---- hands ----
    const pointers = new Map();
    let moved = 0;
    const pan = (dx, dy) => {
        const { right, up } = axes();
        const scale = 2 * opening * view.distance / canvas.clientHeight;
        view.target = add(add(view.target, right, -dx * scale), up, dy * scale);
    };
    const zoom = (factor) => {
        view.distance = Math.min(Math.max(view.distance * factor, 1e-5), 40);
    };
    canvas.addEventListener('contextmenu', (e) => e.preventDefault());
    canvas.addEventListener('pointerdown', (e) => {
        canvas.setPointerCapture(e.pointerId);
        pointers.set(e.pointerId, [e.offsetX, e.offsetY]);
        moved = 0;
    });
    canvas.addEventListener('pointermove', (e) => {
        const before = pointers.get(e.pointerId);
        if (!before) return;
        const [dx, dy] = [e.offsetX - before[0], e.offsetY - before[1]];
        moved += Math.abs(dx) + Math.abs(dy);
        if (pointers.size === 2) {
            const other = [...pointers].find(([id]) => id !== e.pointerId)[1];
            const gap = (p) => Math.hypot(p[0] - other[0], p[1] - other[1]);
            zoom(gap(before) / Math.max(gap([e.offsetX, e.offsetY]), 1));
            pan(dx / 2, dy / 2);
        } else if (e.buttons & 2 || e.buttons & 4 || e.shiftKey) {
            pan(dx, dy);
        } else {
            view.turn -= dx * 0.008;
            view.tilt = Math.min(Math.max(view.tilt + dy * 0.008, -1.57), 1.57);
        }
        pointers.set(e.pointerId, [e.offsetX, e.offsetY]);
        redraw();
    });
    const release = (e) => {
        if (pointers.delete(e.pointerId) && e.type === 'pointerup' && moved < 4) pick(e.offsetX, e.offsetY);
    };
    canvas.addEventListener('pointerup', release);
    canvas.addEventListener('pointercancel', release);
    canvas.addEventListener('wheel', (e) => {
        e.preventDefault();
        zoom(Math.exp(Math.min(Math.max(e.deltaY, -200), 200) * 0.0015));
        redraw();
    }, { passive: false });

    // ---- flights ----
    const fly = (goal) => {
        const start = structuredClone(view), began = performance.now();
        const step = (now) => {
            const t = Math.min((now - began) / 450, 1), s = t * t * (3 - 2 * t);
            view.target = start.target.map((v, i) => v + (goal.target[i] - v) * s);
            view.distance = start.distance * (goal.distance / start.distance) ** s;
            redraw();
            if (t < 1) requestAnimationFrame(step);
        };
        requestAnimationFrame(step);
    };
    const rows = [...document.querySelectorAll('tr[data-low]')];
    let current = -1;
    const visit = (index) => {
        rows[current]?.classList.remove('current');
        current = (index + rows.length) % rows.length;
        const row = rows[current];
        row.classList.add('current');
        const fromFile = (text) => text.split(' ').map((v, i) => ((v - scene.low[i]) / scene.step - half[i]) * unit);
        const low = fromFile(row.dataset.low), high = fromFile(row.dataset.high);
        const radius = Math.max(Math.hypot(...sub(high, low)) / 2, 1e-5);
        fly({ target: low.map((v, i) => (v + high[i]) / 2), distance: 4 * radius });
    };
    rows.forEach((row, index) => row.addEventListener('click', () => visit(index)));
    box.querySelector('[data-next]')?.addEventListener('click', () => visit(current + 1));
    box.querySelector('[data-home]').addEventListener('click', () => fly(home));
    box.querySelectorAll('input').forEach((input) => input.addEventListener('change', redraw));
    window.addEventListener('resize', redraw);
    redraw();
    const asked = /^#region=(\d+)$/.exec(location.hash);  // a page can be linked to at a region
    if (asked && rows[asked[1]]) visit(Number(asked[1]));
})();
