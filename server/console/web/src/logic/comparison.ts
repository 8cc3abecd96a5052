import type { Scene, State, Vec3 } from '../protocol/messages';
import type { Curves, Outline } from '../protocol/recordings';
import { emptyState, type Moment } from './recorded_states';

/** Two recordings on one clock: time `t` of the first one is `t + offset` of the second one. */

/** Returns a scene with the seats and tools of both; names of the second one end with `suffix`. */
export function overlaidScene(a: Scene, b: Scene, suffix: string): Scene {
  const named = <Part extends { name: string }>(parts: readonly Part[]): Part[] =>
    parts.map((part) => ({ ...part, name: `${part.name} ${suffix}` }));
  return {
    ...a,
    session: `${a.session}+${b.session}`,
    seats: [...a.seats, ...named(b.seats)],
    tools: [...a.tools, ...named(b.tools)],
  };
}

const zeros = (n: number): number[] => Array.from({ length: n }, () => 0);
const masters = (scene: Scene): number => scene.seats.filter(({ kind }) => kind === 'MASTER').length;

/** Returns one state with the seats and tools of both. Authority of a master of one over tools of the other is 0. */
export function overlaidState(a: State, b: State, sceneA: Scene, sceneB: Scene): State {
  const [mastersA, mastersB] = [masters(sceneA), masters(sceneB)];
  const [toolsA, toolsB] = [zeros(a.tools.length), zeros(b.tools.length)];
  return {
    ...a,
    seats: [
      ...a.seats.map((seat) => ({ ...seat, alpha: [...seat.alpha, ...toolsB] })),
      ...b.seats.map((seat) => ({ ...seat, alpha: [...toolsA, ...seat.alpha] })),
    ],
    tools: [
      ...a.tools.map((tool) => ({
        ...tool,
        wanted: tool.wanted && [...tool.wanted, ...zeros(mastersB)],
        applied: tool.applied && [...tool.applied, ...zeros(mastersB)],
      })),
      ...b.tools.map((tool) => ({
        ...tool,
        wanted: tool.wanted && [...zeros(mastersA), ...tool.wanted],
        applied: tool.applied && [...zeros(mastersA), ...tool.applied],
      })),
    ],
  };
}

/** Returns the place of a tool at a session time, between two neighbouring points of its curves; null: not known. */
export function placeAt(outline: Outline, tool: number, t: number): Vec3 | null {
  const { curves, from_s } = outline;
  const exact = (t - from_s) / curves.step_s;
  const nearest = Math.round(exact);
  const point = Math.abs(exact - nearest) < 1e-6 ? nearest : Math.floor(exact);
  const share = point === nearest && Math.abs(exact - nearest) < 1e-6 ? 0 : exact - point;
  const place: number[] = [];
  for (let axis = 0; axis < 3; axis += 1) {
    const values = curves.tools[tool]?.x[axis];
    const before = values?.[point] ?? null;
    const after = share === 0 ? before : (values?.[point + 1] ?? null);
    if (before === null || after === null) return null;
    place.push(before + (after - before) * share);
  }
  const [x, y, z] = place;
  return x === undefined || y === undefined || z === undefined ? null : [x, y, z];
}

/** Distance of two places [m]; null if one is not known. */
export function distance(a: Vec3 | null, b: Vec3 | null): number | null {
  return a === null || b === null ? null : Math.hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
}

/** Returns the distance of the tools over time, at the points of the first recording [m]. */
export function differenceCurve(a: Outline, b: Outline, tool: number, offset: number): (number | null)[] {
  return times(a.from_s, a.curves).map((t) => distance(placeAt(a, tool, t), placeAt(b, tool, t + offset)));
}

const pointsOf = (curves: Curves): number => curves.seats[0]?.length ?? curves.tools[0]?.force.length ?? 0;

/** Returns the session time of each point of the curves [s]. */
export function times(from_s: number, curves: Curves): number[] {
  return Array.from({ length: pointsOf(curves) }, (_, i) => from_s + i * curves.step_s);
}

/** Returns the point of the curves whose step has a session time. The values of the last one hold until the end. */
export function pointAt({ from_s, curves }: Outline, t: number): number {
  return Math.min(Math.max(0, pointsOf(curves) - 1), Math.max(0, Math.floor((t - from_s) / curves.step_s + 1e-6)));
}

/** Returns what an overlay shows of two moments: a side without data shows nothing, and both wait for each other. */
export function overlaidMoment(a: Moment, b: Moment, sceneA: Scene, sceneB: Scene, t: number): Moment {
  for (const moment of [a, b]) if (moment.kind === 'loading' || moment.kind === 'failed') return moment;
  if (a.kind === 'gap' && b.kind === 'gap') return a;
  const stateA = a.kind === 'state' ? a.state : emptyState(sceneA, t);
  const stateB = b.kind === 'state' ? b.state : emptyState(sceneB, t);
  return { kind: 'state', state: overlaidState({ ...stateA, t }, stateB, sceneA, sceneB) };
}
