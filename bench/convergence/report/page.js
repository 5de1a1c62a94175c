// Tables sort by any column: what has no value stays last.
for (const table of document.querySelectorAll(".table table")) {
  const headers = [...table.tHead.rows[0].cells], body = table.tBodies[0];
  headers.forEach((header, column) => header.querySelector("button").addEventListener("click", () => {
    const text = header.classList.contains("name");
    const previous = header.getAttribute("aria-sort");
    const sign = previous === "ascending" ? -1 : 1;
    const value = row => row.cells[column].dataset.value;
    const order = (a, b) => text ? a.localeCompare(b) : a - b;
    headers.forEach(other => other.removeAttribute("aria-sort"));
    header.setAttribute("aria-sort", sign > 0 ? "ascending" : "descending");
    body.append(...[...body.rows].sort((a, b) =>
      (value(a) === "") - (value(b) === "") || sign * order(value(a), value(b))));
  }));
}

// A line above each table says what of it is hidden, for as long as it is.
for (const holder of document.querySelectorAll(".holder")) {
  const place = holder.querySelector(".table"), hint = holder.querySelector(".hint"), table = place.querySelector("table");
  const headers = [...table.tHead.rows[0].cells], rows = [...table.tBodies[0].rows];

  function tell() {
    const box = place.getBoundingClientRect(), first = headers[0].getBoundingClientRect().right;
    const names = cells => cells.map(cell => cell.innerText.replace(/\s+/g, " ").trim()).join(", ");
    const end = box.left + place.clientLeft + place.clientWidth;  // without a scroll bar
    const right = headers.slice(1).filter(cell => cell.getBoundingClientRect().right > end + 0.5);
    const left = headers.slice(1).filter(cell => cell.getBoundingClientRect().left < first - 1);
    const below = rows.filter(row => row.getBoundingClientRect().bottom > box.bottom + 1).length;
    const hidden = [left.length && `← ${names(left)}`, right.length && `${names(right)} →`,
      below && `↓ ${below} more row${below > 1 ? "s" : ""}`].filter(Boolean);
    hint.hidden = place.scrollWidth <= place.clientWidth + 1 && place.scrollHeight <= place.clientHeight + 1;
    hint.textContent = hidden.length ? "Scroll the table: " + hidden.join(" · ") : "The end of the table.";
    place.parentNode.classList.toggle("more", right.length > 0);
  }
  place.addEventListener("scroll", tell, {passive: true});
  new ResizeObserver(tell).observe(place);
}

// A closer look at one place of a scene in all its images at once.
for (const looker of document.querySelectorAll(".looker")) {
  const [width, height] = looker.dataset.size.split(" ").map(Number);
  const range = looker.querySelector("input"), buttons = [...looker.querySelectorAll("button")];
  const looks = [...looker.querySelectorAll("figure")].map(figure => {
    const images = [...figure.querySelectorAll(":scope > img")];
    const row = figure.appendChild(Object.assign(document.createElement("div"), {className: "closer"}));
    return images.map(image => {
      const frame = image.parentNode.insertBefore(Object.assign(document.createElement("div"), {className: "view"}), image);
      const marker = document.createElement("i");
      frame.append(image, marker);
      const canvas = row.appendChild(document.createElement("canvas"));
      canvas.setAttribute("role", "img");
      canvas.setAttribute("aria-label", "Closer: " + image.alt);
      return {image, marker, canvas};
    });
  }).flat();
  let center = [0.5, 0.5];

  function look() {
    const across = Math.min(Number(range.max) + Number(range.min) - range.value, width, height);  // closer: fewer pixels
    const corner = [width, height].map((size, axis) =>
      Math.max(0, Math.min(size - across, Math.round(center[axis] * size - across / 2))));
    for (const {image, marker, canvas} of looks) {
      marker.style.cssText = `left:${100 * corner[0] / width}%;top:${100 * corner[1] / height}%;` +
        `width:${100 * across / width}%;height:${100 * across / height}%`;
      canvas.width = canvas.height = across;
      const scale = image.naturalWidth / width;  // 1 unless the page was made with smaller images
      canvas.getContext("2d").drawImage(image, corner[0] * scale, corner[1] * scale, across * scale, across * scale, 0, 0, across, across);
    }
    const there = center.join(" ");
    buttons.forEach(button => button.setAttribute("aria-pressed", button.dataset.place === there));
  }
  const go = place => { center = place; look(); };

  buttons.forEach(button => button.addEventListener("click", () => go(button.dataset.place.split(" ").map(Number))));
  range.addEventListener("input", look);
  for (const {image} of looks) {
    image.addEventListener("click", event => {
      const box = image.getBoundingClientRect();
      go([(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height]);
    });
  }
  Promise.allSettled(looks.map(({image}) => image.decode())).then(() => buttons.length ? buttons[0].click() : look());
}

// A link to a problem opens it.
function openTarget() {
  const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
  if (target instanceof HTMLDetailsElement) target.open = true;
}
addEventListener("hashchange", openTarget);
openTarget();

// Paper has room for what is folded on the screen.
let folded = [];
addEventListener("beforeprint", () => {
  folded = [...document.querySelectorAll("details:not([open])")];
  folded.forEach(details => details.open = true);
});
addEventListener("afterprint", () => folded.forEach(details => details.open = false));
