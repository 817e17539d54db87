// Elements of the page, and numbers in words.

/// An element with properties and children; texts are never read as HTML.
export const make = (tag, properties = {}, ...children) => {
    const made = document.createElement(tag);
    for (const [name, value] of Object.entries(properties)) {
        if (name === 'data') Object.assign(made.dataset, value);
        else if (name === 'style') made.style.cssText = value;
        else if (name in made) made[name] = value;
        else made.setAttribute(name, value);
    }
    made.append(...children.filter((child) => child !== null && child !== undefined));
    return made;
};

/// The parser knows the namespace of SVG, so that no address stands in the page.
const svg = make('div', { innerHTML: '<svg></svg>' }).firstChild.namespaceURI;
export const ofSvg = (tag, properties, ...children) => {
    const made = document.createElementNS(svg, tag);
    for (const [name, value] of Object.entries(properties)) made.setAttribute(name, value);
    made.append(...children);
    return made;
};

export const rounded = (value) => String(Number(value.toPrecision(6)));
export const brief = (value) => String(Number(value.toPrecision(4)));
export const counted = (count, one, many) => `${count.toLocaleString('en')} ${count === 1 ? one : many}`;
export const rgbOf = (color) => [1, 3, 5].map((i) => parseInt(color.slice(i, i + 2), 16));

/// 256 colors between the stops.
export const rampOf = (stops) => {
    const colors = stops.map(rgbOf);
    return Array.from({ length: 256 }, (_, i) => {
        const at = i / 255 * (colors.length - 1), k = Math.min(Math.floor(at), colors.length - 2);
        return colors[k].map((v, c) => Math.round(v + (colors[k + 1][c] - v) * (at - k)));
    });
};
