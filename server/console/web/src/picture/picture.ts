import { AmbientLight, DirectionalLight, Group, Scene as ThreeScene, WebGLRenderer } from 'three';

import type { Scene, State } from '../protocol/messages';
import { CameraRig } from './camera_rig';
import { forceOfArrow } from './force_arrow';
import { HandGhost, type PictureOptions } from './hand_ghost';
import { spread } from './label';
import { readColours, type PictureColours } from './palette';
import { drawMark } from './mark_cells';
import { buildSurfaces, disposeSurfaces } from './surfaces';
import { ToolMark } from './tool_mark';

/** Mean frame time from which the picture lowers its resolution, and below which it raises it [ms]. */
const kSlow = 26;
const kFast = 14;
const kRatioMin = 0.5;
/** Force limit that is assumed if no seat states one [N]. */
const kForceLimit = 3.3;

/** The picture of a session. Lowers its resolution on slow machines, so that motion stays smooth. */
export class Picture {
  readonly canvas: HTMLCanvasElement;
  /** Names of the hands, above the canvas. */
  readonly labels = document.createElement('div');
  readonly rig: CameraRig;
  private readonly renderer: WebGLRenderer;
  private readonly scene = new ThreeScene();
  private surfaces: Group | null = null;
  private colours: PictureColours;
  private readonly hands = new Map<number, HandGhost>();
  private readonly tools = new Map<number, ToolMark>();
  private known: Scene | null = null;
  private ratio = Math.min(2, window.devicePixelRatio || 1);
  private frameTime = kFast;
  private last = 0;
  private size = '';

  /**
   * @param marks draws the time of each drawn state as cells that a test can read
   * @throws Error if the browser has no WebGL
   */
  constructor(
    label: string,
    readonly options: PictureOptions,
    private readonly marks: boolean,
  ) {
    const [canvas, context] = contextOf(this.ratio < 1.5);
    this.canvas = canvas;
    this.labels.className = 'labels';
    this.labels.ariaHidden = 'true';
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute('role', 'img');
    this.canvas.setAttribute('aria-label', label);
    this.renderer = new WebGLRenderer({ canvas, context });
    this.colours = readColours(document.documentElement);
    this.rig = new CameraRig(this.canvas);
    const sun = new DirectionalLight('#ffffff', 2);
    sun.position.set(0.2, -0.4, 0.6);
    this.scene.add(new AmbientLight('#ffffff', 1.6), sun);
  }

  /** Force that an arrow of 10 mm stands for [N]. */
  get forceOf10mm(): number {
    return 0.01 / this.options.forceScale;
  }

  /** Reads the colours again after a change between light and dark. */
  recolour(): void {
    this.colours = readColours(document.documentElement);
    this.known = null;
  }

  /** Draws one frame. Returns whether it shows a state. */
  draw(scene: Scene | null, state: State | null, now_ms: number): boolean {
    if (!this.fit()) return false;
    this.adapt(now_ms);
    if (scene && scene !== this.known) this.adopt(scene);
    if (scene && state) this.update(scene, state);
    this.renderer.render(this.scene, this.rig.camera);
    if (this.marks && state) drawMark(this.renderer, state.t, this.canvas.clientHeight);
    return scene !== null && state !== null;
  }

  private adopt(scene: Scene): void {
    const other = this.known?.session !== scene.session;
    this.known = scene;
    this.scene.background = this.colours.background;
    if (this.surfaces) {
      this.scene.remove(this.surfaces);
      disposeSurfaces(this.surfaces);
    }
    this.surfaces = buildSurfaces(scene.tools, this.colours);
    this.scene.add(this.surfaces);
    if (other) this.clear();
    const limits = scene.seats.map((seat) => seat.force_limit_n ?? 0);
    this.options.forceScale = 0.01 / forceOfArrow(Math.max(...limits, 0) || kForceLimit);
  }

  private clear(): void {
    for (const part of [...this.hands.values(), ...this.tools.values()]) {
      this.scene.remove(part.group);
      part.dispose();
    }
    this.hands.clear();
    this.labels.replaceChildren();
    this.tools.clear();
  }

  private update(scene: Scene, state: State): void {
    const masters = scene.seats.map((seat, i) => (seat.kind === 'MASTER' ? i : -1)).filter((i) => i >= 0);
    state.seats.forEach((seat, i) => {
      // The hand of a slave seat is the tool itself.
      if (scene.seats[i]?.kind === 'SLAVE') return;
      this.hand(i).update(seat, scene.seats[i], state.t, this.colours, this.options);
    });
    state.tools.forEach((tool, i) => {
      this.tool(i).update(tool, scene.tools[i], state, masters, this.colours, this.options);
    });
    const choice = this.rig.choice;
    const seat = choice.startsWith('seat:') ? state.seats[Number(choice.slice(5))] : undefined;
    this.rig.update(seat?.x ?? null, this.options.reducedMotion);
    for (const part of [...this.hands.values(), ...this.tools.values()]) part.face(this.rig.camera.quaternion);
    if (this.options.names) this.placeLabels();
  }

  /** Puts the names above their hands and spreads those that would cover each other. */
  private placeLabels(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const hands = [...this.hands.values()];
    this.rig.camera.updateMatrixWorld();
    const places = hands.map((hand) => {
      const at = hand.top.project(this.rig.camera);
      return { x: ((at.x + 1) / 2) * width, y: ((1 - at.y) / 2) * height };
    });
    spread(places).forEach((place, i) => hands[i]?.label.place(place.x, place.y));
  }

  private hand(index: number): HandGhost {
    const found = this.hands.get(index);
    if (found) return found;
    const made = new HandGhost(index);
    this.hands.set(index, made);
    this.labels.append(made.label.node);
    this.scene.add(made.group);
    return made;
  }

  private tool(index: number): ToolMark {
    const found = this.tools.get(index);
    if (found) return found;
    const made = new ToolMark();
    this.tools.set(index, made);
    this.scene.add(made.group);
    return made;
  }

  /** Follows the size of the host. Returns whether the picture is visible. */
  private fit(): boolean {
    const host = this.canvas.parentElement;
    if (!host) return false;
    const [width, height] = [host.clientWidth, host.clientHeight];
    if (width < 2 || height < 2) return false;
    const size = `${width} ${height} ${this.ratio}`;
    if (size === this.size) return true;
    this.size = size;
    this.renderer.setPixelRatio(this.ratio);
    this.renderer.setSize(width, height);
    this.rig.resize(width / height);
    return true;
  }

  private adapt(now_ms: number): void {
    const step = now_ms - this.last;
    this.last = now_ms;
    if (!(step > 0 && step < 250)) return;
    this.frameTime += (step - this.frameTime) * 0.05;
    const best = Math.min(2, window.devicePixelRatio || 1);
    if (this.frameTime > kSlow && this.ratio > kRatioMin) {
      this.ratio = Math.max(kRatioMin, this.ratio * 0.8);
      this.frameTime = (kSlow + kFast) / 2;
    } else if (this.frameTime < kFast && this.ratio < best) {
      this.ratio = Math.min(best, this.ratio * 1.1);
      this.frameTime = (kSlow + kFast) / 2;
    }
  }
}

const kContext: WebGLContextAttributes = {
  alpha: true,
  antialias: false,
  depth: true,
  powerPreference: 'low-power',
  stencil: false,
};

/**
 * Returns a canvas and its context. A context costs 0.1 s where the browser renders without a graphics processor; there, this
 * makes one only, and without smoothing of edges, which would cost half of the frames.
 * @throws Error if the browser has no WebGL
 */
function contextOf(smooth: boolean): [HTMLCanvasElement, WebGL2RenderingContext] {
  const canvas = document.createElement('canvas');
  const context = canvas.getContext('webgl2', kContext);
  if (!context) throw new Error('the browser has no WebGL 2');
  const info = context.getExtension('WEBGL_debug_renderer_info');
  const name: unknown = info ? context.getParameter(info.UNMASKED_RENDERER_WEBGL) : '';
  if (!smooth || (typeof name === 'string' && /swiftshader|llvmpipe|software/i.test(name))) return [canvas, context];
  const fine = document.createElement('canvas');
  const smoothed = fine.getContext('webgl2', { ...kContext, antialias: true });
  context.getExtension('WEBGL_lose_context')?.loseContext();
  if (!smoothed) throw new Error('the browser has no second WebGL 2 context');
  return [fine, smoothed];
}
