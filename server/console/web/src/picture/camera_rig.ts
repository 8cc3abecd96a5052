import { PerspectiveCamera, Vector3 } from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';

import type { Vec3 } from '../protocol/messages';

/** `seat:N` looks over the hand of seat N. */
export type CameraChoice = 'free' | 'front' | 'above' | `seat:${number}`;

const kDistance = 0.25;
const kTurn = 0.12;

/** Camera with x to the right, y away and z up, as the persons at the seats see their devices. */
export class CameraRig {
  readonly camera = new PerspectiveCamera(38, 1, 0.01, 3);
  private readonly controls: OrbitControls;
  private chosen: CameraChoice = 'free';
  private readonly goal = new Vector3();
  private readonly target = new Vector3();
  private zoom = 1;

  constructor(surface: HTMLElement) {
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, surface);
    this.controls.enablePan = false;
    this.controls.enableDamping = false;
    this.controls.minDistance = 0.06;
    this.controls.maxDistance = 0.8;
    surface.addEventListener('keydown', (event) => this.onKey(event));
    this.choose('free');
  }

  get choice(): CameraChoice {
    return this.chosen;
  }

  choose(choice: CameraChoice): void {
    this.chosen = choice;
    this.zoom = 1;
    this.controls.enabled = choice === 'free';
    this.controls.target.set(0, 0, 0);
    if (choice === 'free') this.camera.position.set(-0.07, -0.18, 0.09);
    this.controls.update();
  }

  resize(aspect: number): void {
    this.camera.aspect = aspect;
    // A narrow picture shows the same width.
    this.camera.fov = aspect < 1.2 ? Math.min(75, 38 * (1.2 / aspect)) : 38;
    this.camera.updateProjectionMatrix();
  }

  /** @param hand place of the chosen seat's hand [m], or null */
  update(hand: Vec3 | null, reducedMotion: boolean): void {
    if (this.chosen === 'free') return;
    const distance = kDistance / this.zoom;
    if (this.chosen === 'front') this.place([0, -distance, 0.02], [0, 0, 0], 1);
    // A camera exactly above would have no direction for "up".
    else if (this.chosen === 'above') this.place([0, -0.001, distance], [0, 0, 0], 1);
    else if (hand) {
      const behind: Vec3 = [hand[0], hand[1] - 0.6 * distance, hand[2] + 0.25 * distance];
      this.place(behind, hand, reducedMotion ? 1 : 0.12);
    }
  }

  private place(position: Vec3, target: Vec3, share: number): void {
    this.goal.set(...position);
    this.camera.position.lerp(this.goal, share);
    this.target.lerp(this.goal.set(...target), share);
    this.camera.lookAt(this.target);
  }

  private onKey(event: KeyboardEvent): void {
    const turn: Record<string, [number, number]> = {
      ArrowLeft: [-kTurn, 0],
      ArrowRight: [kTurn, 0],
      ArrowUp: [0, kTurn],
      ArrowDown: [0, -kTurn],
    };
    const by = turn[event.key];
    if (event.key === '+' || event.key === '-') {
      const factor = event.key === '+' ? 1.15 : 1 / 1.15;
      this.zoom = Math.min(4, Math.max(0.4, this.zoom * factor));
      if (this.chosen === 'free') this.camera.position.multiplyScalar(1 / factor).clampLength(0.06, 0.8);
    } else if (by && this.chosen === 'free') {
      const { x, y, z } = this.camera.position;
      const [radius, azimuth] = [Math.hypot(x, y, z), Math.atan2(y, x) + by[0]];
      const height = Math.min(1.45, Math.max(-1.45, Math.asin(z / radius) + by[1]));
      const flat = radius * Math.cos(height);
      this.camera.position.set(flat * Math.cos(azimuth), flat * Math.sin(azimuth), radius * Math.sin(height));
    } else {
      return;
    }
    this.controls.update();
    event.preventDefault();
    event.stopPropagation();
  }
}
