// Mouse, touch and keys.

/// `act` has turn, pan, zoom, pick and key.
export const listen = (box, canvas, act) => {
    const pointers = new Map();
    let moved = 0;
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
            act.zoom(gap(before) / Math.max(gap([e.offsetX, e.offsetY]), 1));
            act.pan(dx / 2, dy / 2);
        } else if (e.buttons & 2 || e.buttons & 4 || e.shiftKey) {
            act.pan(dx, dy);
        } else {
            act.turn(dx * 0.008, dy * 0.008);
        }
        pointers.set(e.pointerId, [e.offsetX, e.offsetY]);
    });
    const release = (e) => {
        if (pointers.delete(e.pointerId) && e.type === 'pointerup' && moved < 4) act.pick(e.offsetX, e.offsetY);
    };
    canvas.addEventListener('pointerup', release);
    canvas.addEventListener('pointercancel', release);
    canvas.addEventListener('wheel', (e) => {
        e.preventDefault();
        act.zoom(Math.exp(Math.min(Math.max(e.deltaY, -200), 200) * 0.0015));
    }, { passive: false });
    document.addEventListener('keydown', (e) => {
        const typing = /^(INPUT|SELECT|TEXTAREA)$/.test(e.target.tagName) && e.target.type !== 'checkbox';
        if (e.ctrlKey || e.altKey || e.metaKey || typing && e.key !== 'Escape') return;
        if (act.key(e.key, e.shiftKey)) e.preventDefault();
    });
};
