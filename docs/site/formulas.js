// Sets each formula of a page with KaTeX. A formula with an error raises it, which tests/project/check_browser.py sees.
const formulas = [...document.querySelectorAll(".math")];
for (const formula of formulas) {
    katex.render(formula.textContent, formula, {displayMode: formula.tagName === "DIV", strict: "error", trust: false});
}
// A comma or full stop behind a formula goes with it, so that no line begins with one.
for (const formula of formulas) {
    const behind = formula.nextSibling, parts = formula.querySelectorAll(".base");
    const mark = behind?.nodeType === Node.TEXT_NODE && behind.data.match(/^[.,;:)]+/);
    if (mark && formula.tagName === "SPAN") {
        behind.data = behind.data.slice(mark[0].length);
        parts[parts.length - 1].append(mark[0]);
    }
}
// Where a part of a formula fits into no line, as on a telephone, the formula has a line of its own, which can be scrolled.
const isWide = (formula) => {
    const room = 0.9 * formula.closest("p, li, td, div").clientWidth;
    return [...formula.querySelectorAll(".base")].some((part) => part.offsetWidth > room);
};
formulas.filter(isWide).forEach((formula) => formula.classList.add("wide"));
