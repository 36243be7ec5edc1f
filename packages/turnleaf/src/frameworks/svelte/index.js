export { default as TurnleafBook } from "./TurnleafBook.svelte";
