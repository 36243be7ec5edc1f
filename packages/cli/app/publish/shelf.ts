/** The script of the shelf and of pages of text, which do without it. */

import "./site.css";
import { keepVisited } from "./offline.ts";

void keepVisited();
