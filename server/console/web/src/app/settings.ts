import { preferredLanguage, type Language } from '../strings/strings';

export type Theme = 'auto' | 'light' | 'dark';

/** Choices of the person, kept in the browser. */
export interface Settings {
  language: Language;
  theme: Theme;
  keys: boolean;
  /** The picture carries marks that tests of its delay read; no control of the page sets this. */
  marks: boolean;
}

const kName = 'tandem';

function stored(): Partial<Settings> {
  try {
    const found: unknown = JSON.parse(localStorage.getItem(kName) ?? '{}');
    return typeof found === 'object' && found !== null ? found : {};
  } catch {
    return {}; // a browser without storage keeps no choice
  }
}

export function loadSettings(): Settings {
  const found = stored();
  return {
    language:
      found.language === 'en' || found.language === 'fr' ? found.language : preferredLanguage(navigator.languages),
    theme: found.theme === 'light' || found.theme === 'dark' ? found.theme : 'auto',
    keys: found.keys !== false,
    marks: found.marks === true,
  };
}

export function saveSettings(settings: Settings): void {
  try {
    localStorage.setItem(kName, JSON.stringify(settings));
  } catch {
    // The choice holds until the page is closed.
  }
}
