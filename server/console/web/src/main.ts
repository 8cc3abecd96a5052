import './style/base.css';
import './style/views.css';
import './style/recordings.css';
import './style/narrow.css';

import { Connection } from './app/connection';
import { ConsolePage } from './app/console_page';
import { SessionModel } from './logic/session_model';

const root = document.getElementById('page');
if (!root) throw new Error('index.html has no element "page"');

const model = new SessionModel();
const connection = new Connection(model);
new ConsolePage(model, connection, root);
connection.connect();
