import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';

import { describe, expect, it } from 'vitest';

interface LockedPackage {
  version?: string;
  engines?: { node?: string };
}

const read = <T>(name: string): T => JSON.parse(readFileSync(new URL(`../../${name}`, import.meta.url), 'utf8')) as T;
const { satisfies } = createRequire(import.meta.url)('semver') as {
  satisfies: (version: string, range: string) => boolean;
};

describe('the packages of the lock file', () => {
  it('accept the oldest Node that package.json names, and that of Debian 12', () => {
    expect(read<LockedPackage>('package.json').engines?.node).toBe('>=18.18');
    const { packages } = read<{ packages: Record<string, LockedPackage> }>('package-lock.json');
    const limited = Object.entries(packages).filter(([, { engines }]) => engines?.node !== undefined);
    expect(limited.length).toBeGreaterThan(50);
    for (const version of ['18.18.0', '18.20.4']) {
      const refusing = limited.filter(([, { engines }]) => !satisfies(version, engines?.node ?? '*'));
      expect(refusing.map(([name, { engines }]) => `${name} needs Node ${engines?.node}`)).toEqual([]);
    }
  });
});
