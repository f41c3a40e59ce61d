// A page of tables and curves, without drawings in three dimensions.
import { CurvesData, showCurves } from "./curves";

showCurves(JSON.parse(document.getElementById("data")!.textContent!) as CurvesData);
