// The page of a comparison whose results hold a block's stresses: drawings of the block, and curves.
import { ComparedBlocks, showBlocks } from "./block_comparison";
import { CurvesData, showCurves } from "./curves";
import { h } from "./dom";

const data = JSON.parse(document.getElementById("data")!.textContent!) as CurvesData & { block: ComparedBlocks };
showBlocks(data.block, document.getElementById("block")!);
showCurves(data, [h("a", { href: "#block" }, "Block")]);
