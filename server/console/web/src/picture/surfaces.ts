import {
  BoxGeometry,
  EdgesGeometry,
  GridHelper,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshLambertMaterial,
} from 'three';

import type { SceneTool, Surface } from '../protocol/messages';
import type { PictureColours } from './palette';

/** Drawn size of a surface and of its solid side [m]. */
const kSize = 0.09;
const kThickness = 0.008;

function block(surface: Surface, kind: 'wall' | 'tissue', colours: PictureColours): Group {
  const size: [number, number, number] = [kSize, kSize, kSize];
  size[surface.axis] = kThickness;
  const geometry = new BoxGeometry(...size);
  const colour = kind === 'wall' ? colours.wall : colours.tissue;
  const solid = new Mesh(
    geometry,
    new MeshLambertMaterial({
      color: colour,
      transparent: true,
      opacity: kind === 'wall' ? 0.42 : 0.3,
      depthWrite: false,
    }),
  );
  const edges = new LineSegments(new EdgesGeometry(geometry), new LineBasicMaterial({ color: colour }));
  const group = new Group();
  group.add(solid, edges);
  const side = surface.from_below ? 1 : -1;
  group.position.setComponent(surface.axis, surface.at_m + (side * kThickness) / 2);
  return group;
}

/** Returns floor, walls and tissues of all tools. They change with the scene only. */
export function buildSurfaces(tools: readonly SceneTool[], colours: PictureColours): Group {
  const group = new Group();
  const floor = new GridHelper(0.2, 20, colours.grid, colours.grid);
  // GridHelper lies in x and z; the floor of the picture lies in x and y, with z up.
  floor.rotation.x = Math.PI / 2;
  floor.position.z = -0.065;
  group.add(floor);
  for (const tool of tools) {
    for (const wall of tool.walls) group.add(block(wall, 'wall', colours));
    for (const tissue of tool.tissues) group.add(block(tissue, 'tissue', colours));
  }
  return group;
}

export function disposeSurfaces(group: Group): void {
  group.traverse((node) => {
    if (node instanceof Mesh || node instanceof LineSegments) {
      (node.geometry as BoxGeometry).dispose();
      for (const material of [node.material].flat()) (material as LineBasicMaterial).dispose();
    }
  });
}
