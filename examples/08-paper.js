import "turnleaf";

const book = document.querySelector("turnleaf-book");
const form = document.querySelector("form");

function make() {
  const { stock, grain, wind, assist } = form.elements;
  const speed = Number(wind.value);
  // Whole papers may be given in figures instead: {grammage, caliper, stiffnessAlong, stiffnessAcross}.
  book.paper = {
    stock: stock.value,
    grain: grain.value,
    wind: [-speed, 0, 0],
    assist: assist.checked,
  };
  document.querySelector("output").textContent = `Wind: ${speed} m/s`;
}

form.addEventListener("input", make);
make();
