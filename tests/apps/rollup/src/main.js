import "turnleaf";

document.querySelector("turnleaf-book").addEventListener("pagechange", (event) => {
  document.querySelector("output").textContent = event.detail.to;
});
