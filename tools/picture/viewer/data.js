// Unpacks what a tool has put into the page; README.md says how it is packed.
import { sub, add, cross, dot, length, scaled, unit as unitVector, emptyBox, grow, isEmpty } from './vector.js';

/// Zigzag varints in base64, one after the other.
const numbersOf = (base64) => {
    const text = atob(base64.trim());
    const bytes = new Uint8Array(text.length);
    for (let i = 0; i < bytes.length; ++i) bytes[i] = text.charCodeAt(i);
    let at = 0;
    return () => {
        let byte = bytes[at++], value = byte & 127, scale = 128;
        while (byte > 127) {
            byte = bytes[at++];
            value += (byte & 127) * scale;
            scale *= 128;
        }
        return value % 2 ? -(value + 1) / 2 : value / 2;
    };
};

/// Reads points in the coordinates of the view: the longest side of the box is from -1 to 1.
const pointReader = (scene, next) => {
    const last = [0, 0, 0];
    const { half, unit } = scene;
    return (into, at) => {
        for (let axis = 0; axis < 3; ++axis) {
            last[axis] += next();
            into[at + axis] = (last[axis] - half[axis]) * unit;
        }
    };
};

/// Values are steps of a millionth of the map's range, those not below it plus 1; 0 says that there is none.
export const noValue = -1000;
const readValue = (next) => {
    const code = next();
    return code === 0 ? noValue : (code > 0 ? code - 1 : code) / 1e6;
};

const readMesh = (scene, mesh, next) => {
    const read = pointReader(scene, next);
    const points = new Float32Array(3 * mesh.points);
    for (let i = 0; i < mesh.points; ++i) read(points, 3 * i);
    const ofPoint = mesh.has_values ? Float32Array.from({ length: mesh.points }, () => readValue(next)) : null;
    const F = mesh.faces;
    mesh.positions = new Float32Array(9 * F);
    mesh.kinds = new Uint8Array(3 * F);
    mesh.values = ofPoint && new Float32Array(3 * F);
    mesh.numbers = new Float64Array(F);
    mesh.groups = mesh.group_word ? new Float64Array(F) : null;
    for (let f = 0, corner = 0, number = 0; f < F; ++f) {
        for (let i = 3 * f; i < 3 * f + 3; ++i) {
            corner += next();
            mesh.positions[3 * i] = points[3 * corner];
            mesh.positions[3 * i + 1] = points[3 * corner + 1];
            mesh.positions[3 * i + 2] = points[3 * corner + 2];
            if (ofPoint) mesh.values[i] = ofPoint[corner];
        }
        mesh.numbers[f] = number += next();
        const kind = next();
        mesh.kinds[3 * f] = mesh.kinds[3 * f + 1] = mesh.kinds[3 * f + 2] = kind;
        if (mesh.groups) mesh.groups[f] = next();
    }
};

const readLines = (scene, lines, next) => {
    const read = pointReader(scene, next);
    lines.positions = new Float32Array(6 * lines.count);
    lines.numbers = lines.word ? new Float64Array(lines.count) : null;
    for (let i = 0, number = 0; i < lines.count; ++i) {
        read(lines.positions, 6 * i);
        read(lines.positions, 6 * i + 3);
        if (lines.numbers) lines.numbers[i] = number += next();
    }
};

const readDots = (scene, dots, next) => {
    const read = pointReader(scene, next);
    const N = dots.count;
    dots.positions = new Float32Array(3 * N);
    dots.kinds = new Uint8Array(N);
    dots.numbers = new Float64Array(N);
    dots.groups = dots.group_word ? new Float64Array(N) : null;
    dots.values = dots.has_values ? new Float32Array(N) : null;
    dots.normals = dots.has_normals ? new Float32Array(3 * N) : null;
    for (let i = 0, number = 0; i < N; ++i) {
        read(dots.positions, 3 * i);
        dots.numbers[i] = number += next();
        dots.kinds[i] = next();
        if (dots.groups) dots.groups[i] = next();
        if (dots.values) dots.values[i] = readValue(next);
        if (dots.normals) for (let axis = 0; axis < 3; ++axis) dots.normals[3 * i + axis] = next() / 1000;
    }
};

/// Normals of dots are lines of the same class.
const spikesOf = (dots) => {
    const positions = new Float32Array(6 * dots.count);
    for (let i = 0; i < dots.count; ++i)
        for (let axis = 0; axis < 3; ++axis) {
            positions[6 * i + axis] = dots.positions[3 * i + axis];
            positions[6 * i + 3 + axis] = dots.positions[3 * i + axis] + 0.12 * dots.normals[3 * i + axis];
        }
    return { class: dots.kinds[0] ?? 0, count: dots.count, positions, variant: dots.variant, numbers: null, width: 2 };
};

/// An arrow as a mesh of twelve sides: a shaft and a head.
const arrowMesh = (scene, arrow) => {
    const from = scene.toView(arrow.from), way = sub(scene.toView(arrow.to), from);
    const long = length(way), direction = unitVector(way);
    const side = unitVector(cross(direction, Math.abs(direction[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0]));
    const other = cross(direction, side);
    const thick = 0.008, head = Math.min(0.1, 0.5 * long);
    const ring = (along, radius, i) => add(add(add(from, direction, along),
        side, radius * Math.cos(i * Math.PI / 6)), other, radius * Math.sin(i * Math.PI / 6));
    const positions = [];
    const outline = [[0, 0], [0, thick], [long - head, thick], [long - head, 3.5 * thick], [long, 0]];
    for (let part = 1; part < outline.length; ++part)
        for (let i = 0; i < 12; ++i) {
            const [a, b] = [i, i + 1].map((k) => ring(...outline[part - 1], k));
            const [c, d] = [i, i + 1].map((k) => ring(...outline[part], k));
            positions.push(...a, ...b, ...d, ...a, ...d, ...c);
        }
    const faces = positions.length / 9;
    return { name: arrow.text, word: 'arrow', faces, positions: new Float32Array(positions), arrow: true,
        kinds: new Uint8Array(3 * faces).fill(arrow.class), values: null, groups: null, variant: '',
        numbers: new Float64Array(faces) };
};

const boxAndArea = (scene) => {
    const whole = emptyBox(), faces = emptyBox(), marks = emptyBox();
    const context = (kind) => scene.classes[kind].context;
    const put = (p, i, found) => {
        grow(whole, p[i], p[i + 1], p[i + 2]);
        if (found) grow(found, p[i], p[i + 1], p[i + 2]);
    };
    let area = 0;
    const samples = [];  // some of all points, to fit into the picture
    const sample = (p, count) => {
        const step = Math.max(1, Math.ceil(count / 2000));
        for (let i = 0; i < count; i += step) samples.push([p[3 * i], p[3 * i + 1], p[3 * i + 2]]);
    };
    for (const { positions: p, kinds, faces: count, ghost } of scene.meshes)
        for (let f = 0; f < count; ++f) {
            const i = 9 * f, found = !ghost && !context(kinds[3 * f]) && faces;
            for (let k = 0; k < 9; k += 3) put(p, i + k, found);
            const ux = p[i + 3] - p[i], uy = p[i + 4] - p[i + 1], uz = p[i + 5] - p[i + 2];
            const vx = p[i + 6] - p[i], vy = p[i + 7] - p[i + 1], vz = p[i + 8] - p[i + 2];
            area += Math.hypot(uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx) / 2;
        }
    for (const { positions, kinds } of scene.meshes) sample(positions, kinds.length);
    for (const { positions, count } of scene.lines) sample(positions, 2 * count);
    for (const { positions, count } of scene.dots) sample(positions, count);
    for (const { positions, count, class: kind } of scene.lines)
        for (let i = 0; i < 2 * count; ++i) put(positions, 3 * i, !context(kind) && marks);
    for (const { positions, count, kinds } of scene.dots)
        for (let i = 0; i < count; ++i) put(positions, 3 * i, !context(kinds[i]) && marks);
    if (isEmpty(whole)) grow(whole, 0, 0, 0);
    // Faces that meet may be long; where they meet is what one looks for.
    Object.assign(scene, { whole, findings: isEmpty(marks) ? faces : marks, area, samples });
};

export const readScene = (json, base64) => {
    const scene = JSON.parse(json);
    const next = numbersOf(base64);
    scene.unit = 2 / scene.steps;
    scene.half = scene.size.map((s) => s / 2);
    scene.toView = (p) => p.map((v, i) => ((v - scene.low[i]) / scene.step - scene.half[i]) * scene.unit);
    scene.toFile = (p) => p.map((v, i) => scene.low[i] + (v / scene.unit + scene.half[i]) * scene.step);
    scene.lengthInFile = (v) => v / scene.unit * scene.step;
    for (const mesh of scene.meshes) readMesh(scene, mesh, next);
    for (const lines of scene.lines) readLines(scene, lines, next);
    for (const dots of scene.dots) readDots(scene, dots, next);
    boxAndArea(scene);
    for (const dots of scene.dots) if (dots.normals) scene.lines.push(spikesOf(dots));
    for (const arrow of scene.arrows) scene.meshes.push(arrowMesh(scene, arrow));
    scene.variants = ['before', 'after'].filter((v) => scene.meshes.some((m) => m.variant === v));
    return scene;
};

/// Where the ray from `eye` along `ray` meets the plane of a face, or its first corner.
export const hitOfFace = (mesh, face, eye, ray) => {
    const [a, b, c] = [0, 3, 6].map((i) => [...mesh.positions.subarray(9 * face + i, 9 * face + i + 3)]);
    const normal = cross(sub(b, a), sub(c, a));
    const share = dot(normal, sub(a, eye)) / dot(normal, ray);
    return { corners: [a, b, c], point: Number.isFinite(share) ? add(eye, ray, share) : a };
};

/// The value of the map at a point of a face, between those of its corners.
export const valueAt = (mesh, face, [a, b, c], point) => {
    const normal = cross(sub(b, a), sub(c, a));
    const weight = (p, q) => dot(normal, cross(sub(q, p), sub(point, p))) / dot(normal, normal);
    const [x, y, z] = [0, 1, 2].map((i) => mesh.values[3 * face + i]);
    return weight(b, c) * x + weight(c, a) * y + weight(a, b) * z;
};

/// Texts at places of the view.
export const labelsOf = (scene) => [
    ...scene.labels.map((l) => ({ at: scene.toView(l.at), text: l.text, class: l.class, variant: '' })),
    ...scene.arrows.map((a) => ({ at: scaled(add(scene.toView(a.from), scene.toView(a.to)), 0.5), text: a.text,
        class: a.class, variant: '' })),
    ...scene.lines.filter((l) => l.labeled).flatMap((l) => Array.from({ length: Math.min(l.count, 200) }, (_, i) => {
        const [a, b] = [0, 3].map((k) => [...l.positions.subarray(6 * i + k, 6 * i + k + 3)]);
        return { at: scaled(add(a, b), 0.5), class: l.class, variant: l.variant,
            text: l.text || (l.labeled === 'length' ? scene.say(scene.lengthInFile(length(sub(b, a)))) : String(l.numbers[i])) };
    }))];
