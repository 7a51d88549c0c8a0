"use strict";

// Mice and fingers on a pane: pointing, clicking, dragging and the wheel.

const DRAG = 4; // pixels of the screen: less is a click of a hand that is not quite still

function listenToPointer(viewer, pane) {
  const { host } = pane;
  let start = null;
  const placeOf = (event) => {
    const box = host.getBoundingClientRect();
    const { x, y, scale } = viewer.view;
    return [x + (event.clientX - box.left) / scale, y + (event.clientY - box.top) / scale];
  };
  host.addEventListener("pointerdown", (event) => {
    start = { at: [event.clientX, event.clientY], view: { ...viewer.view }, isDrag: false };
  });
  host.addEventListener("pointermove", (event) => {
    if (start && event.buttons === 1) {
      const [right, down] = [event.clientX - start.at[0], event.clientY - start.at[1]];
      start.isDrag ||= Math.hypot(right, down) > DRAG;
      if (!start.isDrag) return;
      viewer.view = {
        ...start.view,
        x: start.view.x - right / start.view.scale,
        y: start.view.y - down / start.view.scale,
      };
      viewer.isFitted = false;
      refresh(viewer);
    } else if (!viewer.isPinned && event.pointerType === "mouse") choosePixel(viewer, ...placeOf(event));
  });
  host.addEventListener("click", (event) => {
    const wasDrag = start?.isDrag;
    start = null;
    if (wasDrag) return;
    viewer.isPinned = true;
    viewer.stage.focus({ preventScroll: true });
    choosePixel(viewer, ...placeOf(event));
  });
  host.addEventListener(
    "wheel",
    (event) => {
      if (document.activeElement !== viewer.stage && !event.ctrlKey) return; // else the page scrolls
      event.preventDefault();
      zoomAbout(viewer, 2 ** (-event.deltaY / 240), ...placeOf(event));
    },
    { passive: false },
  );
}

function choosePixel(viewer, x, y) {
  const within = (value, size) => Math.min(Math.max(Math.floor(value) || 0, 0), size - 1);
  viewer.pixel = { x: within(x, viewer.cell.width), y: within(y, viewer.cell.height) };
  refresh(viewer);
}
