import { en, type StringKey } from './en';
import { fr } from './fr';

export type { StringKey };
export type Language = 'en' | 'fr';
export const kLanguages: Readonly<Record<Language, Readonly<Record<StringKey, string>>>> = { en, fr };

let language: Language = 'en';

export function setLanguage(chosen: Language): void {
  language = chosen;
}

export function currentLanguage(): Language {
  return language;
}

/** Returns the language of the browser if the page has it, otherwise English. */
export function preferredLanguage(wanted: readonly string[]): Language {
  for (const tag of wanted) {
    const found = (Object.keys(kLanguages) as Language[]).find((known) => tag.toLowerCase().split('-')[0] === known);
    if (found) return found;
  }
  return 'en';
}

/** Returns the text of a key in the current language, with the words in braces replaced. */
export function t(key: StringKey, words: Readonly<Record<string, string | number>> = {}): string {
  return kLanguages[language][key].replace(/\{(\w+)\}/g, (whole, name: string) =>
    Object.prototype.hasOwnProperty.call(words, name) ? String(words[name]) : whole,
  );
}

/** Returns the text of `prefix.word`, or the word itself if the page does not know it: a newer gateway may send new words. */
export function word(prefix: string, value: string | null): string {
  if (value === null || value === '') return '–';
  const key = `${prefix}.${value}`;
  return Object.prototype.hasOwnProperty.call(en, key) ? t(key as StringKey) : value;
}
