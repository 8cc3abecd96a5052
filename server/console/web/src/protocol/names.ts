/**
 * Names of scenes, sessions, persons, seats and workstations: the rule of the server, `is_name` in
 * proto/rpc/rpc_texts.h. The test Names.HaveOneRuleInServerAndPage compares both.
 */
export const kNamePattern = '[A-Za-z0-9_\\-]{1,32}';
export const kNameMax = 32;

const kName = new RegExp(`^${kNamePattern}$`);

export function isName(text: string): boolean {
  return kName.test(text);
}
