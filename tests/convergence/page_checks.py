"""What a page of the report has to keep, at any width and in light and dark: each is a script that lists what is wrong."""

# The pieces of text of an element, and of a figure at the size it is shown at, each with its box.
PIECES = """
    const range = document.createRange();  // one for all: each has to be kept up with whatever the page changes
    const textsOf = element => {
        const walker = document.createTreeWalker(element, NodeFilter.SHOW_TEXT), found = [];
        while (walker.nextNode()) {
            const node = walker.currentNode;
            if (!node.data.trim() || node.parentElement.closest("script, style")) continue;
            range.selectNodeContents(node);
            found.push({text: node.data.trim(), parent: node.parentElement, box: range.getBoundingClientRect()});
        }
        return found;
    };
    const figures = () => [...document.images].filter(image => image.src.startsWith("data:image/svg")).map(image => ({
        name: image.alt.slice(0, 50), source: image.src, width: image.getBoundingClientRect().width
    })).map(({name, source, width}, i, all) => {
        // A document of its own is laid out fast.
        const frame = document.querySelector("iframe") ?? document.body.appendChild(document.createElement("iframe"));
        const place = frame.contentDocument.body;
        frame.style.cssText = "position:absolute;left:0;top:0;width:1000px;height:1000px;max-width:none;padding:0;border:0";
        place.style.cssText = `margin:0;width:${width}px`;
        place.innerHTML = decodeURIComponent(source.slice(source.indexOf(",") + 1));
        const svg = place.querySelector("svg");
        svg.setAttribute("width", "100%");
        svg.removeAttribute("height");
        const outer = svg.getBoundingClientRect(), scale = outer.width / svg.viewBox.baseVal.width;
        const texts = [...svg.querySelectorAll("text")].map(text => ({
            text: text.textContent.trim(), box: text.getBoundingClientRect(),
            size: parseFloat(frame.contentWindow.getComputedStyle(text).fontSize) * scale}));
        if (i === all.length - 1) frame.remove();
        return {name, outer, texts};
    });"""

CHECKS = {
    "everything is in the page": """
        return performance.getEntriesByType("resource").map(entry => entry.name).filter(name => !name.startsWith("data:"))
            .map(name => "it loads " + name)""",
    "every image and plot shows": """
        const wrong = [...document.images].filter(image => {
            const box = image.getBoundingClientRect();
            return !image.complete || image.naturalWidth < 8 || box.width < 40 || box.height < 15;
        }).map(image => "not shown: " + image.alt);
        if (!document.images.length) wrong.push("there is no image");
        return wrong.concat([...document.images].filter(image => !image.alt).map(() => "an image without words for it"))""",
    "no figure is missing": """
        return [...document.querySelectorAll("p, td, th, dd, li, figcaption, summary")].map(e => e.innerText)
            .filter(text => /undefined|\\bNone\\b|\\bnan\\b|\\binf\\b/.test(text)).map(text => "the text has: " + text)""",
    "nothing is wider than the screen": """
        const width = document.documentElement.clientWidth;
        if (document.documentElement.scrollWidth > width) return ["the page scrolls sideways"];
        return [...document.querySelectorAll("p, h1, h2, h3, img, canvas, dd, li, .table, .map, pre, summary")]
            .filter(e => !e.closest(".table") || e.matches(".table"))
            .filter(e => e.getBoundingClientRect().right > width + 1
                || e.scrollWidth > e.clientWidth + 1 && e.matches("p, h1, h2, h3, dd, pre, summary"))
            .map(e => "too wide: " + e.outerHTML.slice(0, 80))""",
    "text can be read": PIECES + """
        return textsOf(document.body).filter(piece => parseFloat(getComputedStyle(piece.parent).fontSize) < 11)
            .map(piece => "too small: " + piece.text.slice(0, 60))
            .concat(figures().flatMap(figure => figure.texts.filter(text => !(text.size >= 10.9))
                .map(text => `too small, ${text.size.toFixed(1)} px: ${text.text} in ${figure.name}`)))""",
    "text stands out": PIECES + """
        const numbers = color => color.match(/[\\d.]+/g).map(Number);
        const luminance = color => numbers(color).slice(0, 3).map(c => c / 255)
            .map(c => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4)
            .reduce((sum, c, i) => sum + c * [0.2126, 0.7152, 0.0722][i], 0);
        const background = element => {
            for (; element; element = element.parentElement) {
                const color = getComputedStyle(element).backgroundColor;
                if ((numbers(color)[3] ?? 1) > 0.99) return color;
            }
            return "rgb(255, 255, 255)";
        };
        return [...new Set(textsOf(document.body).map(piece => {
            const one = luminance(getComputedStyle(piece.parent).color), other = luminance(background(piece.parent));
            const contrast = (Math.max(one, other) + 0.05) / (Math.min(one, other) + 0.05);
            return contrast >= 4.5 ? null : `contrast ${contrast.toFixed(1)}: ${piece.text.slice(0, 40)}`;
        }).filter(Boolean))].slice(0, 5)""",
    "text in figures stands apart, and whole": PIECES + """
        const wrong = [];
        for (const {name, outer, texts} of figures()) {
            texts.forEach((one, i) => {
                const {left, right, top, bottom} = one.box;
                if (left < outer.left - 1 || right > outer.right + 1 || top < outer.top - 2 || bottom > outer.bottom + 2)
                    wrong.push(`cut off: ${one.text} in ${name}`);
                for (const other of texts.slice(i + 1)) {
                    // A line's box is higher than its letters.
                    const slack = 0.15 * Math.min(one.box.height, other.box.height);
                    if (other.box.left < right && left < other.box.right && other.box.top + slack < bottom - slack
                        && top + slack < other.box.bottom - slack)
                        wrong.push(`${one.text} runs into ${other.text} in ${name}`);
                }
            });
        }
        return wrong""",
    "text in cells stays there": PIECES + """
        return [...document.querySelectorAll(".map :is(td, th)")].flatMap(cell => {
            const box = cell.getBoundingClientRect();
            return textsOf(cell).filter(piece => piece.box.left < box.left - 0.5 || piece.box.right > box.right + 0.5)
                .map(piece => piece.text + " runs out of its cell");
        })""",
    "what a table hides is said": """
        const wrong = [], isDesk = document.documentElement.clientWidth >= 1400;
        for (const place of document.querySelectorAll(".table")) {
            const name = place.ariaLabel, isWide = place.scrollWidth > place.clientWidth + 1;
            const isLong = place.scrollHeight > place.clientHeight + 1;
            if (isWide && isDesk) wrong.push(`${name} is cut off by ${place.scrollWidth - place.clientWidth} px`);
            const hint = place.closest(".holder")?.querySelector(".hint");
            const isSaid = hint && hint.getBoundingClientRect().height > 0;
            if (!isWide && !isLong) {
                if (isSaid) wrong.push(name + " has a hint, but hides nothing");
                continue;
            }
            if (!isSaid) {
                wrong.push(name + " is cut off without a word");
                continue;
            }
            const last = place.querySelector("thead tr").lastElementChild;
            const words = last.innerText.replace(/\\s+/g, " ").trim();
            if (isWide && !hint.innerText.includes(words)) wrong.push(`the hint at ${name} does not name ${words}`);
            if (Math.abs(place.getBoundingClientRect().top - hint.getBoundingClientRect().bottom) > 40)
                wrong.push("the hint is far from " + name);
            place.scrollTo(1e6, 1e6);
            const box = place.getBoundingClientRect(), row = place.querySelector("table").rows;
            if (last.getBoundingClientRect().right > box.right + 1
                || row[row.length - 1].getBoundingClientRect().bottom > box.bottom + 1)
                wrong.push(name + " does not scroll to its end");
            place.scrollTo(0, 0);
        }
        return wrong""",
    "colors have a legend": """
        return [...document.querySelectorAll("section")].filter(section => section.querySelector("td[class*=level]"))
            .filter(section => section.querySelectorAll(".levels i").length < 5)
            .map(section => "no legend: " + section.querySelector("h2").innerText)""",
    "an answer comes before its figures": """
        const table = document.querySelector("section[aria-labelledby=overview] table");
        if (!table) return [];
        const isBefore = e => e && e.compareDocumentPosition(table) & Node.DOCUMENT_POSITION_FOLLOWING;
        const section = table.closest("section"), isMeasured = /\\d/.test(table.tFoot.innerText);
        const wrong = isBefore(section.querySelector("p.lead")) ? [] : ["no sentence"];
        return isMeasured && !isBefore(section.querySelector("figure img")) ? wrong.concat("no picture") : wrong""",
    "it says how to make it again": """
        const section = document.getElementById("again")?.closest("section");
        const text = section?.offsetHeight ? section.innerText : "";
        return ["build/demo/bench/convergence/convergence --output", "report.py"].filter(word => !text.includes(word))
            .map(word => "the page does not say: " + word)""",
    "tables sort by each column, both ways": """
        const wrong = [];
        for (const table of document.querySelectorAll(".table table")) {
            [...table.tHead.rows[0].cells].forEach((header, column) => {
                for (const again of [false, true]) {
                    header.querySelector("button").click();
                    const sign = header.getAttribute("aria-sort") === "descending" ? -1 : 1;
                    const values = [...table.tBodies[0].rows].map(row => row.cells[column].dataset.value);
                    const known = values.filter(value => value !== "");
                    const isText = header.classList.contains("name");
                    const inOrder = (a, b) => isText ? sign * a.localeCompare(b) <= 0 : sign * (a - b) <= 0;
                    if (!known.every((value, i) => i === 0 || inOrder(known[i - 1], value))
                        || values.slice(known.length).some(value => value !== ""))
                        wrong.push(header.innerText + " does not sort in " + table.closest(".table").ariaLabel);
                    if (!isText && known.some(value => isNaN(Number(value)))) wrong.push(header.innerText + " is not of numbers");
                }
            });
        }
        if (!document.querySelector("table")) wrong.push("there is no table");
        return wrong""",
    "a closer look follows, pixel by pixel": """
        const wrong = [];
        for (const looker of document.querySelectorAll(".looker")) {
            const [width] = looker.dataset.size.split(" ").map(Number);
            wrong.push(...[...looker.querySelectorAll(".view img")].filter(image => image.naturalWidth !== width)
                .map(image => `${image.alt} has ${image.naturalWidth} of ${width} pixels`));
            const seen = () => [...looker.querySelectorAll("canvas")].map(canvas => canvas.toDataURL()).join();
            const views = [...looker.querySelectorAll("canvas")];
            if (views.length !== looker.querySelectorAll(".view").length || views.length < 3) wrong.push("a view is missing");
            const isBlank = canvas => canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data
                .every(byte => byte === 0);
            if (views.some(isBlank)) wrong.push("a view is blank");
            const before = seen(), image = looker.querySelector(".view img"), box = image.getBoundingClientRect();
            image.dispatchEvent(new MouseEvent("click", {clientX: box.left + 1, clientY: box.top + 1}));
            if (seen() === before) wrong.push("a tap changes nothing");
            const far = seen(), range = looker.querySelector("input");
            range.value = range.max;
            range.dispatchEvent(new Event("input"));
            if (seen() === far) wrong.push("no closer");
            looker.querySelector("button").click();
            if (looker.querySelectorAll("button[aria-pressed=true]").length !== 1) wrong.push("no button is pressed");
        }
        return wrong""",
}

# Before anything is opened.
AT_FIRST = {
    "a page of one problem shows it": """
        const problems = document.querySelectorAll("main details[id], main article[id]");
        return problems.length === 1 && problems[0].matches("details:not([open])") ? ["it is folded"] : []""",
}

# On paper, of which every sheet is as wide as the screen here.
ON_PAPER = {
    "nothing is cut off on paper": """
        const width = document.documentElement.clientWidth;
        return [...document.querySelectorAll("table")].filter(table => table.getBoundingClientRect().right > width + 1)
            .map(table => `cut off: ${table.closest("[aria-label]")?.ariaLabel ?? "a map"}`)""",
    "everything is unfolded on paper": """
        dispatchEvent(new Event("beforeprint"));
        return document.querySelector("details:not([open])") ? ["a problem stays folded"] : []""",
}
