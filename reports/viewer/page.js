"use strict";

// What every page has, after its own scripts.

addPageTools();
