// Mounts the lab into the page.
import { render } from "preact";
import "./shell/look.css";
import { watchRest } from "./api/rest";
import { takeToken } from "./api/token";
import { Lab } from "./shell/Lab";

watchRest();
takeToken();
const place = document.getElementById("lab");
if (place) render(<Lab />, place);
