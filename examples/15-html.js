import "turnleaf";

document.querySelector("form").addEventListener("submit", (event) => {
  event.preventDefault();
  const { guest, nights } = Object.fromEntries(new FormData(event.target));
  document.querySelector("output").textContent = `${guest || "Somebody"} comes for ${nights}.`;
});
