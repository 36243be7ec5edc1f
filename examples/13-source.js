import "turnleaf";
import { PolygonBook } from "./13-polygons.js";

document.querySelector("turnleaf-book").pages = () => new PolygonBook(100);
