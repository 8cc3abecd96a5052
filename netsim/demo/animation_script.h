#pragma once

#include <string_view>

namespace tandem::netsim::demo {

/// Script that draws kRuns (see animation.cpp) on a canvas in two views, front and above. It makes no network request.
inline constexpr std::string_view kAnimationScript = R"js((() => {
  const element = id => document.getElementById(id);
  const canvas = element('player-view'), slider = element('player-time'), choice = element('player-run');
  const button = element('player-play'), text = element('player-text'), pen = canvas.getContext('2d');
  const kTrail = 2 * kRate;
  const bodies = [{name: 'trainer', at: 0, colour: '--trainer'}, {name: 'trainee', at: 3, colour: '--trainee'},
                  {name: 'slave', at: 6, colour: '--slave'}];
  const views = [{title: 'from the front', across: 0, up: 2, labels: ['x, right', 'z, up']},
                 {title: 'from above', across: 0, up: 1, labels: ['x, right', 'y, away']}];
  let run, frame = 0, playing = false, begun = 0;

  const value = (k, i) => run.frames[k * kValues + i];
  const colour = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

  function choose() {
    run = kRuns[choice.value];
    run.count = run.frames.length / kValues;
    // One scale for both views, so that a circle stays a circle.
    run.centre = [0, 1, 2].map(axis => {
      let lo = Infinity, hi = -Infinity;
      for (let k = 0; k < run.count; k++)
        for (const body of bodies) {
          lo = Math.min(lo, value(k, body.at + axis));
          hi = Math.max(hi, value(k, body.at + axis));
        }
      return {middle: (lo + hi) / 2, span: Math.max(hi - lo, 100)};
    });
    slider.max = run.count - 1;
    show(Math.min(frame, run.count - 1));
  }

  function draw_view(view, left, top, width, height) {
    const span = 1.15 * Math.max(run.centre[view.across].span / width, run.centre[view.up].span / height);
    const px = v => left + width / 2 + (v - run.centre[view.across].middle) / span;
    const py = v => top + height / 2 - (v - run.centre[view.up].middle) / span;
    pen.save();
    pen.beginPath(); pen.rect(left, top, width, height); pen.clip();
    if (run.wall) {
      pen.fillStyle = colour('--grid');
      pen.fillRect(px(0), top, left + width - px(0), height);
      pen.fillStyle = colour('--soft');
      pen.fillText('wall', px(0) + 5, top + height - 8);
    }
    for (const body of [...bodies].reverse()) {
      pen.strokeStyle = pen.fillStyle = colour(body.colour);
      pen.lineWidth = body.name === 'slave' ? 4 : 1.5;
      pen.beginPath();
      for (let k = Math.max(0, frame - kTrail); k <= frame; k++)
        pen.lineTo(px(value(k, body.at + view.across)), py(value(k, body.at + view.up)));
      pen.stroke();
      const x = px(value(frame, body.at + view.across)), y = py(value(frame, body.at + view.up));
      pen.beginPath();
      if (body.name === 'slave') pen.rect(x - 8, y - 8, 16, 16); else pen.arc(x, y, 6, 0, 2 * Math.PI);
      pen.fill();
    }
    pen.restore();
    pen.strokeStyle = colour('--rule'); pen.lineWidth = 1; pen.strokeRect(left, top, width, height);
    pen.fillStyle = colour('--soft');
    pen.fillText(view.title + ' (' + view.labels.join('; ') + ')', left + 6, top + 16);
    const ruler = 200 / span;  // 20 mm
    pen.fillRect(left + 8, top + height - 26, ruler, 2);
    pen.fillText('20 mm', left + 8, top + height - 10);
  }

  function show(k) {
    frame = k;
    slider.value = k;
    const ratio = window.devicePixelRatio || 1, width = canvas.clientWidth, stacked = width < 600;
    const side = stacked ? width : (width - 12) / 2, height = Math.min(side, 380);
    canvas.style.height = (stacked ? 2 * height + 12 : height) + 'px';
    canvas.width = width * ratio;
    canvas.height = (stacked ? 2 * height + 12 : height) * ratio;
    pen.scale(ratio, ratio);
    pen.font = '13px system-ui, sans-serif';
    views.forEach((view, n) => draw_view(view, stacked ? 0 : n * (side + 12), stacked ? n * (height + 12) : 0, side, height));
    const apart = at => Math.hypot(...[0, 1, 2].map(a => value(k, at + a) - value(k, 6 + a))) / 10;
    text.textContent = 't = ' + (k / kRate).toFixed(2) + ' s. Authority: trainer ' + (value(k, 11) / 100).toFixed(2) +
      ', trainee ' + (1 - value(k, 11) / 100).toFixed(2) + '. To the tool: trainer ' + apart(0).toFixed(1) + ' mm, trainee ' +
      apart(3).toFixed(1) + ' mm. Force: trainer ' + (value(k, 9) / 100).toFixed(2) + ' N, trainee ' +
      (value(k, 10) / 100).toFixed(2) + ' N.';
    slider.setAttribute('aria-valuetext', (k / kRate).toFixed(1) + ' s');
  }

  function play(on) {
    playing = on;
    button.textContent = on ? 'Pause' : 'Play';
    if (!on) return;
    if (frame >= run.count - 1) frame = 0;
    begun = performance.now() - 1000 * frame / kRate;
    const step = now => {
      if (!playing) return;
      const k = Math.floor((now - begun) / 1000 * kRate);
      show(Math.max(0, Math.min(k, run.count - 1)));
      if (k >= run.count - 1) play(false); else requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  choice.addEventListener('change', () => { play(false); choose(); });
  button.addEventListener('click', () => play(!playing));
  slider.addEventListener('input', () => { play(false); show(Number(slider.value)); });
  window.addEventListener('resize', () => show(frame));
  window.matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => show(frame));
  choose();
  show(Math.min(6 * kRate, run.count - 1));  // in the middle of the gesture
})();
)js";

}  // namespace tandem::netsim::demo
