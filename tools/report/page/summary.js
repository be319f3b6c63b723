// Who, what and how well: the numbers, as the program printed them from the result file.

const inUnits = (item) => (state.units === "field" && item.field ? item.field : item.si);

function addSummary() {
  const section = addSection("summary", "Summary");
  const { title, status, made } = metadata;
  section.append(
    element("h1", {}, title),
    element("p", { class: "origin" },
      element("span", { class: `status ${status.good ? "good" : "alert"}` }, status.text), ` · ${made}`),
  );
  if (metadata.warnings.length)
    section.append(element("ul", { class: "alerts" },
      ...metadata.warnings.map((text) => element("li", {}, text))));
  const tiles = element("div", { class: "tiles" });
  const facts = element("div", { class: "facts" });
  if (metadata.tiles.length)
    section.append(element("p", { class: "hint" }, "At the last record; the greatest stress is that of the whole run."));
  section.append(tiles, facts);
  addWords(section, () => {
    tiles.replaceChildren(...metadata.tiles.map((item) =>
      element("div", { class: "tile" },
        element("div", { class: "label" }, item.label),
        element("div", { class: "value", id: `value-${item.id}` }, inUnits(item)))));
    facts.replaceChildren(...metadata.facts.map((group) =>
      element("table", {}, element("caption", {}, group.title),
        element("tbody", {}, ...group.items.map((item) =>
          element("tr", {}, element("th", { scope: "row" }, item.label),
            element("td", { id: `value-${item.id}` }, inUnits(item))))))));
  });
  if (metadata.notes.length)
    section.append(...metadata.notes.map((text) => element("p", { class: "hint" }, text)));
}

function addCase() {
  if (!metadata.case_text) return;
  const section = addSection("case", "Case", "The case file of this run, overrides applied.");
  section.append(element("details", {}, element("summary", {}, "Show the case file"),
    element("pre", {}, metadata.case_text)));
}
