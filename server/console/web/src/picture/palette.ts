import { Color } from 'three';

/** Colours of the picture, read from the style sheet so that light and dark agree with the page. */
export interface PictureColours {
  background: Color;
  grid: Color;
  wall: Color;
  tissue: Color;
  tool: Color;
  contact: Color;
  limit: Color;
  text: string;
  label: string;
}

export function readColours(host: Element): PictureColours {
  const style = getComputedStyle(host);
  const value = (name: string, otherwise: string): string => style.getPropertyValue(name).trim() || otherwise;
  return {
    background: new Color(value('--picture', '#eef2f5')),
    grid: new Color(value('--picture-grid', '#c3ccd4')),
    wall: new Color(value('--picture-wall', '#8b98a5')),
    tissue: new Color(value('--picture-tissue', '#d98a86')),
    tool: new Color(value('--picture-tool', '#33414e')),
    contact: new Color(value('--picture-contact', '#c2410c')),
    limit: new Color(value('--red', '#b42318')),
    text: value('--text', '#16212b'),
    label: value('--surface', '#ffffff'),
  };
}
