/** Starts the mock gateway by hand: npm run mock -- [seats] [role] */
import { startMock } from './gateway.mjs';

const [seats, role] = process.argv.slice(2);
const gateway = await startMock({ seats: Number(seats ?? 2), role: role ?? 'OPERATOR', freeSeat: true });
console.log(gateway.entry());
