// Mounts the lab, or a saved report.
import { render } from "preact";
import "./shell/look.css";
import { answers } from "./api/answers";
import { watchRest } from "./api/rest";
import { takeToken } from "./api/token";
import { Report } from "./report/Report";
import { Lab } from "./shell/Lab";

watchRest();
const place = document.getElementById("lab");
if (answers && place) render(<Report answers={answers} />, place);
else if (place) {
  takeToken();
  render(<Lab />, place);
}
