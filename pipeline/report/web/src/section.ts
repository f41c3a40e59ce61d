// A section of the report.

import { Child } from "./dom";

export interface Section { id: string; title: string; short?: string; content: Child }
