/** Colours of seats, distinguishable with colour blindness. Source: Okabe and Ito 2008, without black and yellow. */
const kSeatColours = ['#0072b2', '#e69f00', '#009e73', '#cc79a7', '#56b4e9', '#d55e00', '#8b6bd6', '#7a8b00'] as const;

/** Returns the colour of a seat as CSS text. */
export function seatColour(index: number): string {
  return kSeatColours[index % kSeatColours.length] ?? kSeatColours[0];
}
