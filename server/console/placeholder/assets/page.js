'use strict';
const at = (id) => document.getElementById(id);
let next = 1, newest = null;
const socket = new WebSocket(`${location.protocol === 'https:' ? 'wss' : 'ws'}://${location.host}/live`);
const order = (body) => socket.send(JSON.stringify({ type: 'order', id: next++, ...body }));
const line = (text) => { const row = document.createElement('li'); row.textContent = text; at('events').append(row); while (at('events').childElementCount > 50) at('events').firstChild.remove(); };
socket.onmessage = ({ data }) => {
  const message = JSON.parse(data);
  if (message.type === 'hello') { at('link').textContent = message.role; for (const name of ['stop', 'pause', 'resume']) at(name).disabled = !message.may.includes(name); }
  if (message.type === 'state') { newest = message; at('state').textContent = JSON.stringify(message, null, 1); socket.send(JSON.stringify({ type: 'ack', n: message.n })); }
  if (message.type === 'event' || message.type === 'notice') line(message.text);
  if (message.type === 'reply' && !message.ok) line(message.text);
};
socket.onclose = () => { at('link').textContent = 'connection lost; reload the page'; };
at('stop').onclick = () => order({ order: 'stop', why: 'from the console' });
at('pause').onclick = () => order({ order: 'pause', why: 'from the console' });
at('resume').onclick = () => { if (newest && newest.stop) order({ order: 'resume', stop: newest.stop.number }); };
