// Where one looks from: a target, a distance, a turn about the vertical and a tilt.
import { add, sub, dot, cross, center, corners, isEmpty, radius } from './vector.js';

const opening = Math.tan(0.35);  // of half the height
const right = Math.PI / 2;
export const views = {
    front: [0, 0], back: [Math.PI, 0], left: [-right, 0], right: [right, 0], top: [0, right], bottom: [0, -right],
    oblique: [-0.6, 0.45],
};

export class Camera {
    constructor(box, yIsUp) {
        this.whole = box;
        this.reach = Math.max(radius(box), 1e-6);
        this.yIsUp = yIsUp;
        [this.turn, this.tilt] = views.oblique;
        this.target = center(box);
        this.distance = 1;
        this.back = 1;  // times the distance, for pictures that are narrower
    }

    axes() {
        const stand = ([x, y, z]) => this.yIsUp ? [x, z, -y] : [x, y, z];
        const { turn, tilt } = this;
        const back = stand([Math.cos(tilt) * Math.sin(turn), -Math.cos(tilt) * Math.cos(turn), Math.sin(tilt)]);
        const side = stand([Math.cos(turn), Math.sin(turn), 0]);
        return { back, right: side, up: cross(back, side), eye: add(this.target, back, this.distance * this.back) };
    }

    /// Column by column, for a picture of this ratio of width to height.
    matrix(ratio) {
        const { back, right: side, up, eye } = this.axes();
        const reach = Math.hypot(...sub(this.target, center(this.whole))) + this.reach;
        const away = this.distance * this.back;
        const far = away + 1.05 * reach + 0.3;
        const near = Math.max(away - 1.05 * reach - 0.3, 0.002 * away);
        const sx = 1 / opening / ratio, sy = 1 / opening;
        const a = (far + near) / (far - near), b = 2 * far * near / (far - near);
        const columns = [0, 1, 2].map((i) => [sx * side[i], sy * up[i], -a * back[i], -back[i]]);
        const depth = dot(back, eye);
        return new Float32Array([...columns.flat(), -sx * dot(side, eye), -sy * dot(up, eye), a * depth - b, depth]);
    }

    /// The ray through a place of the picture, from 0 to 1 to the right and down.
    ray(x, y, ratio) {
        const { back, right: side, up, eye } = this.axes();
        const [h, v] = [(2 * x - 1) * opening * ratio, (1 - 2 * y) * opening];
        return { eye, ray: side.map((s, i) => s * h + up[i] * v - back[i]) };
    }

    /// Target and distance that show a box, or these points about its center, seen as now.
    fit(box, ratio, points = corners(box)) {
        const { back, right: side, up } = this.axes();
        const target = center(box), margin = 1.12;
        let distance = 1e-5;
        for (const point of points) {
            const p = sub(point, target);
            const wide = Math.max(Math.abs(dot(p, side)) / ratio, Math.abs(dot(p, up))) / opening;
            distance = Math.max(distance, dot(p, back) + wide * margin);
        }
        return { target, distance };
    }

    pan(dx, dy, height) {
        const { right: side, up } = this.axes();
        const scale = 2 * opening * this.distance * this.back / height;
        this.target = add(add(this.target, side, -dx * scale), up, dy * scale);
    }

    zoom(factor) {
        this.distance = Math.min(Math.max(this.distance * factor, 1e-5), 60);
    }

    orbit(dx, dy) {
        this.turn -= dx;
        this.tilt = Math.min(Math.max(this.tilt + dy, -right), right);
    }
}

/// The box to begin with: all, unless that is so thin, as with two long rods, that it would be lines;
/// then what was found, with some of what is around it.
export const boxThatMatters = ({ whole, findings, area }) => {
    const all = 2 * radius(whole);
    if (isEmpty(findings) || Math.sqrt(area) > 0.25 * all) return whole;
    const room = Math.max(2 * radius(findings), area / all);
    if (room > all / 4) return whole;
    return { low: findings.low.map((v) => v - room), high: findings.high.map((v) => v + room) };
};
