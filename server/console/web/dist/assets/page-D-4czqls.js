class Dm{constructor(t=110){this.limit=t,this.sent=[]}take(t,e=0){return this.sent=this.sent.filter(n=>t-n<1e3),this.sent.length+e>=this.limit?!1:(this.sent.push(t),!0)}}class Im{constructor(){this.newest=0,this.acknowledged=0,this.dropped=0}received(t,e){t<this.newest&&(this.acknowledged=0),this.newest=t,this.dropped=e}get due(){return this.newest!==this.acknowledged}next(){return this.due?(this.acknowledged=this.newest,this.newest):null}reset(){this.newest=0,this.acknowledged=0,this.dropped=0}}const Um=5e3,Nm=32;class km{constructor(){this.pending=new Map,this.next=1}get length(){return this.pending.size}add(t,e){if(this.pending.size>=Nm)return null;const n=this.next++;return this.pending.set(n,{sent_ms:t,done:e}),n}reply(t,e){const n=t.id===null?void 0:this.pending.get(t.id);return!n||t.id===null?!1:(this.pending.delete(t.id),n.done(t,e-n.sent_ms),!0)}expire(t,e){for(const[n,s]of this.pending)t-s.sent_ms>Um&&this.fail(n,e)}failAll(t){for(const e of[...this.pending.keys()])this.fail(e,t)}fail(t,e){const n=this.pending.get(t);this.pending.delete(t),n?.done({type:"reply",id:t,ok:!1,text:e},NaN)}}class Om{constructor(){this.attempts=0}next(t){const e=Math.min(5e3,250*2**this.attempts);return this.attempts=Math.min(this.attempts+1,10),e*(.75+.5*t)}reset(){this.attempts=0}}const xo=24,Ad=8,Fm=1e3,Bm=1<<20,zm=1e3,Hm=["WAITING","RUNNING","STOPPED","PAUSED","OVER"],Gm=["OSATS","GEARS","GOALS","CHECKLIST"],Eo=i=>typeof i=="object"&&i!==null&&!Array.isArray(i),Ei=i=>Eo(i)?i:{},Hn=(i,t=zm)=>Array.isArray(i)?i.slice(0,t):[],Ce=i=>typeof i=="number"&&Number.isFinite(i)?i:null,ss=i=>{const t=Ce(i);return t!==null&&t>=0?Math.floor(t):0},Mr=i=>typeof i=="boolean"?i:null,Vm=/[\u0000-\u001f\u007f-\u009f\u200e\u200f\u202a-\u202e\u2066-\u2069]/g,le=i=>typeof i=="string"?i.slice(0,Fm).replace(Vm," "):"",yr=i=>typeof i=="string"?le(i):null,pu=i=>Hn(i).filter(t=>typeof t=="string").map(le);function Ds(i){const[t,e,n]=Hn(i,3).map(Ce);return t==null||e===void 0||e===null||n===void 0||n===null?null:[t,e,n]}function hc(i){if(!Array.isArray(i))return null;const t=[];for(const e of Hn(i,xo)){const n=Ce(e);if(n===null||n<0||n>1)return null;t.push(n)}return t}function mu(i){const t=Ei(i),e=Ce(t.at_m),n=t.axis;return e===null||n!==0&&n!==1&&n!==2?[]:[{axis:n,at_m:e,stiffness_n_m:Ce(t.stiffness_n_m),from_below:t.from_below===!0}]}function Wm(i){const t=Ei(i);return{name:le(t.name),kind:t.kind==="SLAVE"?"SLAVE":"MASTER",role:le(t.role),required:Mr(t.required),device:yr(t.device),force_limit_n:Ce(t.force_limit_n)}}function Xm(i){const t=Ei(i);return{name:le(t.name),mass_kg:Ce(t.mass_kg),walls:Hn(t.walls,16).flatMap(mu),tissues:Hn(t.tissues,16).flatMap(mu)}}function qm(i){const t=Ei(i);return{taken:Mr(t.taken),heard:Mr(t.heard),person:yr(t.person),engaged:Mr(t.engaged),gate:yr(t.gate),x:Ds(t.x),f:Ds(t.f),alpha:hc(t.alpha)??[],rtt_ms:Ce(t.rtt_ms),loss_percent:Ce(t.loss_percent),gap_ms:Ce(t.gap_ms),age_ms:Ce(t.age_ms),margin_j:Ce(t.margin_j),trips:Ce(t.trips),late:Ce(t.late),temperature_c:Ce(t.temperature_c)}}function Ym(i){const t=Ei(i),e=Eo(t.transfer)?t.transfer:null;return{x:Ds(t.x),v:Ds(t.v),f:Ds(t.f),depth_m:Ce(t.depth_m),touching:Mr(t.touching),wanted:hc(t.wanted),applied:hc(t.applied),transfer:e&&{by:le(e.by),to:le(e.to),alpha:Ce(e.alpha),ticks:Ce(e.ticks)}}}function jm(i){return Eo(i)?{number:ss(i.number),kind:le(i.kind),by:le(i.by),why:le(i.why),yours:i.yours===!0}:null}function Km(i){return Eo(i)?{by_server:i.by_server===!0,by_recorders:ss(i.by_recorders),pseudonyms:i.pseudonyms===!0,dropped:ss(i.dropped),trouble:le(i.trouble)}:null}function $m(i){const t=Ce(i.n);return t===null||t<0||!Number.isSafeInteger(t)?null:{type:"state",n:t,dropped:ss(i.dropped),wall_us:Ce(i.wall_us),t:Ce(i.t)??0,phase:Hm.find(e=>e===i.phase)??"WAITING",stop:jm(i.stop),version:ss(i.version),shed:ss(i.shed),held:le(i.held),recording:Km(i.recording),seats:Hn(i.seats,xo).map(qm),tools:Hn(i.tools,Ad).map(Ym)}}function Zm(i){const t=Object.create(null);for(const[e,n]of Object.entries(Ei(i)).slice(0,64)){const s=Ce(n);s!==null&&(t[le(e)]=s)}return t}const gu={state:$m,hello:i=>({type:"hello",protocol:ss(i.protocol),release:le(i.release),person:le(i.person),role:le(i.role),may:pu(i.may),sessions:Hn(i.sessions).map(Ei).map(t=>({id:le(t.id),name:le(t.name),state:le(t.state)})),scenes:pu(i.scenes),play:yr(i.play)}),scene:i=>({type:"scene",session:le(i.session),name:le(i.name),tick_hz:Ce(i.tick_hz),dof:Ce(i.dof),law:yr(i.law),seats:Hn(i.seats,xo).map(Wm),tools:Hn(i.tools,Ad).map(Xm)}),event:i=>({type:"event",session:le(i.session),number:ss(i.number),t:Ce(i.t),text:le(i.text)}),reply:i=>({type:"reply",id:Ce(i.id),ok:i.ok===!0,text:le(i.text)}),notice:i=>({type:"notice",level:i.level==="error"||i.level==="warning"?i.level:"info",text:le(i.text)}),seat:i=>({type:"seat",seat:le(i.seat),f:Ds(i.f),x:Ds(i.x),engaged:Mr(i.engaged),phase:le(i.phase),joined:i.joined!==!1,ended:yr(i.ended)??(le(i.seat)===""?"left":null)}),notes:i=>({type:"notes",marks:Hn(i.marks).map(Ei).map(t=>({t:Ce(t.t),text:le(t.text),person:le(t.person)})),sheets:Hn(i.sheets).map(Ei).flatMap(t=>{const e=Gm.find(n=>n===t.sheet);return e===void 0?[]:[{sheet:e,of:le(t.of),person:le(t.person),scores:Zm(t.scores),closed:t.closed===!0}]})}),tickets:i=>({type:"tickets",session:le(i.session),name:le(i.name),tickets:Hn(i.tickets,xo*2).map(Ei).map(t=>({person:le(t.person),role:le(t.role),seat:le(t.seat),ticket:le(t.ticket)}))})};function Jm(i){if(i.length>Bm)return null;let t;try{t=JSON.parse(i)}catch{return null}if(!Eo(t)||typeof t.type!="string")return null;const e=Object.prototype.hasOwnProperty.call(gu,t.type)?gu[t.type]:void 0;return e?e(t):null}const Rd={"language.name":"English","nav.label":"Views","nav.live":"Live","nav.instructor":"Instructor","nav.evaluator":"Evaluator","nav.seat":"Seat","nav.desk":"Lesson desk","nav.skip":"Skip to content","bar.session":"Session","bar.language":"Language","bar.theme":"Colours","theme.auto":"as the system","theme.light":"light","theme.dark":"dark","bar.sound":"Sound","bar.keys":"Keys","bar.invite":"Invite another browser","bar.invitation":"URL for the other browser, valid once and for 10 minutes","bar.keys_help":"Keys: S stops, P pauses, R resumes, M marks, 1 to 5 choose the view.","bar.person":"{person}, {role}","bar.settings":"Settings","recording.server":"Recorded by the server","recording.server_pseudonyms":"Recorded by the server, without names","recording.recorders":"Recorded from outside ({count})","recording.trouble":"Ticks are missing now: {why}","recording.dropped":"Ticks missing so far: {count}","recording.start":"Record","recording.stop":"End recording","link.connecting":"connecting","link.open":"connected","link.lost":"connection lost, trying again","link.refused":"no access","delay.value":"Delay {ms}","delay.old":"No new state for {s}","delay.none":"Waiting for the first state","delay.help":"Age of the picture: transport, waiting and interpolation. States not sent: {dropped}; not drawn: {skipped}.","phase.WAITING":"waiting","phase.RUNNING":"running","phase.STOPPED":"stopped","phase.PAUSED":"paused","phase.OVER":"over","role.INSTRUCTOR":"instructor","role.TRAINEE":"trainee","role.EVALUATOR":"evaluator","role.OBSERVER":"observer","role.OPERATOR":"operator","role.RECORDER":"recorder","join.title":"Join the session","join.explain":"This browser has no access yet. Type the ticket that you received, or open the link with it.","join.ticket":"Ticket","join.name":"Your name","join.go":"Join","join.failed":"The gateway could not be reached. Try again.","picture.label":"Picture of the session. Arrow keys turn the camera, plus and minus zoom.","picture.camera":"Camera","camera.free":"free","camera.front":"front","camera.above":"above","camera.seat":"at seat {seat}","picture.trails":"Trails of 3 s","picture.forces":"Forces","picture.names":"Names","picture.scale":"Arrow of 10 mm: {n} N","picture.none":"This browser has no WebGL. The table below shows the values.","picture.contact":"Contact","picture.limit":"force limit","picture.values":"Values","picture.legend":"Hands","values.what":"Object","values.position":"Position (mm)","values.force":"Force (N)","values.authority":"Authority","values.depth":"depth {mm}","stop.stop":"STOP","stop.pause":"Pause","stop.resume":"Resume","stop.drain":"Drain…","stop.remove":"Remove…","stop.active":"{kind} by {by}: {why}","stop.no_reason":"no reason given","stop.not_yours":"Only the person who stopped, or an instructor, may resume.","stop.kind.STOP":"Stop","stop.kind.PAUSE":"Pause","stop.kind.FAULT":"Fault","stop.why":"from the console","order.no_connection":"There is no connection to the gateway. The order was not sent.","order.unanswered":"No answer within 5 s. Look at the picture before you repeat the order.","order.too_many":"Too many orders at once. Repeat this one in a second.","order.not_allowed":"Your role does not allow this.","order.sent":"{what}: done","order.refused":"{what} was refused: {why}","who.title":"Who is here","who.seat":"Seat","who.person":"Person","who.role":"Role","who.device":"Device","who.state":"State","who.free":"free","who.lost":"lost","who.engaged":"engaged","who.released":"released","who.remove_title":"Remove the participant at seat {seat}","who.reason":"Reason","who.cancel":"Cancel","drain.title":"Drain the server","drain.explain":"All sessions end after the grace time. No new participant can join.","drain.grace":"Grace time (s)","authority.title":"Authority","authority.tool":"Tool","authority.wanted":"wanted","authority.applied":"applied","authority.share_of":"Authority of {seat}","authority.apply":"Apply","authority.reset":"Discard","authority.presets":"Presets","authority.demonstration":"Demonstration","authority.guidance":"Guidance","authority.evaluation":"Evaluation of {seat}","authority.hand_over":"Hand over to","authority.share":"Share","authority.give":"Hand over","authority.transfer":"{by} gives {alpha} to {to}. Begins in {ticks} ticks.","authority.no_transfer":"No transfer is announced.","authority.draft":"Not applied yet","authority.explain":"A transfer is announced for {ticks} ticks before it begins.","cards.title":"Seats","cards.quantity":"Last minute of","cards.gate":"Gate","cards.force":"Force","cards.of_limit":"{f} of {limit}","cards.rtt":"Round trip","cards.loss":"Loss","cards.gap":"Longest gap","cards.age":"Age","cards.margin":"Energy margin","cards.trips":"Trips","cards.late":"Late ticks","cards.temperature":"Temperature","cards.link":"Link quality","cards.spark":"{quantity} of {seat} in the last minute, now {value}","quantity.force":"force (N)","quantity.rtt":"round trip (ms)","quantity.loss":"loss (%)","quantity.margin":"energy margin (J)","band.green":"green: usable for stiff contact and fast motion","band.amber":"amber: usable for slow motion and soft contact","band.red":"red: outside the limits for force feedback","band.unknown":"no verdict","level.green":"good","level.amber":"attention","level.red":"beyond the limit","level.unknown":"unknown","gate.ON":"on","gate.OFF":"off","gate.RISING":"rising","gate.RELEASING":"releasing","gate.LATCHED":"latched off","gate.FAULT":"fault","alarms.title":"Alarms","alarms.none":"No alarm so far.","alarms.lasting":"lasting","alarms.until":"until {t}","alarm.stopped":"Session stopped by {seat}. {detail}","alarm.fault":"Fault: {seat}. {detail}","alarm.lost":"Seat {seat}: no data from the device.","alarm.gate":"Seat {seat}: the force is latched off.","alarm.clipping":"Seat {seat}: the force is at the limit of the device.","alarm.link":"Seat {seat}: link quality red.","alarm.margin":"Seat {seat}: no energy left, damping is added.","alarm.trip":"Seat {seat}: the safety gate tripped, {detail} in all.","alarm.late":"Seat {seat}: late ticks, {detail} in all.","alarm.hot":"Seat {seat}: the device is too hot.","alarm.shed":"The server sheds load, level {detail}.","alarm.connection":"No connection to the gateway. {detail}","events.title":"Events","events.none":"No event so far.","notices.title":"Messages","notices.dismiss":"Dismiss","marks.title":"Timeline","marks.note":"Note","marks.add":"Mark now","marks.at":"Mark at {t}","marks.none":"No mark so far.","marks.timeline":"Marks from the begin of the session to {t}","marks.placeholder":"what happened","sheet.title":"Sheets","sheet.kind":"Sheet","sheet.of":"Person at seat","sheet.OSATS":"OSATS, global rating","sheet.GEARS":"GEARS","sheet.GOALS":"GOALS","sheet.CHECKLIST":"Checklist","sheet.low":"1 = lowest, 5 = highest","sheet.done":"Tick what was done.","sheet.total":"Total {points} of {of}","sheet.missing":"{n} items without a score","sheet.optional":"optional","sheet.save":"Save draft","sheet.close":"Close sheet","sheet.closed":"This sheet is closed. It cannot be changed.","sheet.closed_as_draft":"Close is possible when all items have a score.","sheet.others":"Other evaluators","sheet.hidden":"Scores of other evaluators are shown after you closed your sheet.","sheet.no_others":"No other evaluator has closed this sheet.","item.respect_for_tissue":"Respect for tissue","item.time_and_motion":"Time and motion","item.instrument_handling":"Instrument handling","item.knowledge_of_instruments":"Knowledge of instruments","item.use_of_assistants":"Use of assistants","item.flow_and_forward_planning":"Flow of operation and forward planning","item.knowledge_of_procedure":"Knowledge of procedure","item.depth_perception":"Depth perception","item.bimanual_dexterity":"Bimanual dexterity","item.efficiency":"Efficiency","item.force_sensitivity":"Force sensitivity","item.robotic_control":"Robotic control","item.autonomy":"Autonomy","item.tissue_handling":"Tissue handling","item.device_checked":"Device checked before the task","item.task_explained":"Task explained and understood","item.contact_gentle":"First contact without impact","item.target_reached":"Target reached","item.no_force_limit":"Force limit never reached","item.hand_over_clear":"Hand-over announced and confirmed","seat.title":"Browser seat","seat.choose":"Free seat","seat.take":"Take seat","seat.leave":"Leave seat","seat.none_free":"No master seat is free.","seat.not_allowed":"The gateway or your role does not allow browser seats.","seat.yours":"You have seat {seat}.","seat.pad":"Pad of the hand. Hold and drag, or use the arrow keys; space holds and releases.","seat.plane":"Pad shows","seat.front":"right and up","seat.above":"right and away","seat.depth_front":"Away from you (mm)","seat.depth_above":"Up (mm)","seat.hold":"Hold","seat.held":"Your hand holds the device.","seat.released":"Your hand is released. Press on the pad to hold the device.","seat.force":"Force on your hand","seat.gamepad":"Gamepad: left stick right and up, right stick away, first button holds.","seat.gamepad_on":"Gamepad connected.","seat.intended":"intended","seat.actual":"actual","seat.explain":"The dashed circle is where you want the hand, the filled one is where it is. The line between both is the force.","desk.title":"New session","desk.scene":"Scene","desk.name":"Name of the session","desk.people":"People","desk.person":"Name of person {n}","desk.role":"Role of person {n}","desk.seat":"Seat of person {n} (empty without seat)","desk.add":"Add person","desk.drop":"Remove person {n}","desk.create":"Create session","desk.begins":"A session begins when all its required seats are taken.","desk.end":"End session","desk.tickets":"Tickets of session {name}","desk.ticket_of":"Ticket of {person}","desk.single_use":"Each ticket works once. Give each link to its person only.","desk.link":"Link for the browser","desk.step1":"Install the client: apt install tandem-client.","desk.step2":"Connect the device and look at it: tandem-client doctor.","desk.step3":"Join with the ticket: tandem-client join --server SERVER --ticket-file FILE --seat {seat}.","desk.steps":"With a real device","desk.print":"Print","desk.qr":"QR code of the link for {person}"},Qm={"language.name":"Français","nav.label":"Vues","nav.live":"Direct","nav.instructor":"Instructeur","nav.evaluator":"Évaluateur","nav.seat":"Poste","nav.desk":"Préparation","nav.skip":"Aller au contenu","bar.session":"Session","bar.language":"Langue","bar.theme":"Couleurs","theme.auto":"comme le système","theme.light":"clair","theme.dark":"sombre","bar.sound":"Son","bar.keys":"Touches","bar.invite":"Inviter un autre navigateur","bar.invitation":"URL pour l’autre navigateur, valable une fois, pendant 10 minutes","bar.keys_help":"Touches : S arrête, P met en pause, R reprend, M marque, 1 à 5 choisissent la vue.","bar.person":"{person}, {role}","bar.settings":"Réglages","recording.server":"Enregistrée par le serveur","recording.server_pseudonyms":"Enregistrée par le serveur, sans noms","recording.recorders":"Enregistrée de l’extérieur ({count})","recording.trouble":"Il manque des ticks en ce moment : {why}","recording.dropped":"Ticks manquants jusqu’ici : {count}","recording.start":"Enregistrer","recording.stop":"Terminer l’enregistrement","link.connecting":"connexion en cours","link.open":"connecté","link.lost":"connexion perdue, nouvel essai","link.refused":"pas d’accès","delay.value":"Retard {ms}","delay.old":"Aucun état depuis {s}","delay.none":"En attente du premier état","delay.help":"Âge de l’image : transport, attente et interpolation. États non envoyés : {dropped} ; non dessinés : {skipped}.","phase.WAITING":"en attente","phase.RUNNING":"en cours","phase.STOPPED":"arrêtée","phase.PAUSED":"en pause","phase.OVER":"terminée","role.INSTRUCTOR":"instructeur","role.TRAINEE":"apprenant","role.EVALUATOR":"évaluateur","role.OBSERVER":"observateur","role.OPERATOR":"opérateur","role.RECORDER":"enregistreur","join.title":"Rejoindre la session","join.explain":"Ce navigateur n’a pas encore d’accès. Saisissez le billet que vous avez reçu, ou ouvrez son lien.","join.ticket":"Billet","join.name":"Votre nom","join.go":"Rejoindre","join.failed":"La passerelle est injoignable. Réessayez.","picture.label":"Image de la session. Les flèches tournent la caméra, plus et moins changent le zoom.","picture.camera":"Caméra","camera.free":"libre","camera.front":"de face","camera.above":"de dessus","camera.seat":"au poste {seat}","picture.trails":"Traces de 3 s","picture.forces":"Forces","picture.names":"Noms","picture.scale":"Flèche de 10 mm : {n} N","picture.none":"Ce navigateur n’a pas WebGL. Le tableau ci-dessous montre les valeurs.","picture.contact":"Contact","picture.limit":"limite de force","picture.values":"Valeurs","picture.legend":"Mains","values.what":"Objet","values.position":"Position (mm)","values.force":"Force (N)","values.authority":"Autorité","values.depth":"profondeur {mm}","stop.stop":"ARRÊT","stop.pause":"Pause","stop.resume":"Reprendre","stop.drain":"Vider…","stop.remove":"Retirer…","stop.active":"{kind} par {by} : {why}","stop.no_reason":"sans raison donnée","stop.not_yours":"Seul l’auteur de l’arrêt, ou un instructeur, peut reprendre.","stop.kind.STOP":"Arrêt","stop.kind.PAUSE":"Pause","stop.kind.FAULT":"Défaut","stop.why":"depuis la console","order.no_connection":"Pas de connexion avec la passerelle. L’ordre n’est pas parti.","order.unanswered":"Pas de réponse en 5 s. Regardez l’image avant de répéter l’ordre.","order.too_many":"Trop d’ordres à la fois. Répétez celui-ci dans une seconde.","order.not_allowed":"Votre rôle ne le permet pas.","order.sent":"{what} : fait","order.refused":"{what}, refusé : {why}","who.title":"Personnes présentes","who.seat":"Poste","who.person":"Personne","who.role":"Rôle","who.device":"Appareil","who.state":"État","who.free":"libre","who.lost":"perdu","who.engaged":"engagé","who.released":"relâché","who.remove_title":"Retirer la personne du poste {seat}","who.reason":"Raison","who.cancel":"Annuler","drain.title":"Vider le serveur","drain.explain":"Toutes les sessions finissent après le délai. Personne ne peut plus entrer.","drain.grace":"Délai (s)","authority.title":"Autorité","authority.tool":"Outil","authority.wanted":"voulue","authority.applied":"appliquée","authority.share_of":"Autorité de {seat}","authority.apply":"Appliquer","authority.reset":"Abandonner","authority.presets":"Préréglages","authority.demonstration":"Démonstration","authority.guidance":"Guidage","authority.evaluation":"Évaluation de {seat}","authority.hand_over":"Donner la main à","authority.share":"Part","authority.give":"Donner la main","authority.transfer":"{by} donne {alpha} à {to}. Début dans {ticks} pas.","authority.no_transfer":"Aucun transfert annoncé.","authority.draft":"Pas encore appliqué","authority.explain":"Un transfert est annoncé {ticks} pas avant son début.","cards.title":"Postes","cards.quantity":"Dernière minute de","cards.gate":"Porte de force","cards.force":"Force","cards.of_limit":"{f} sur {limit}","cards.rtt":"Aller-retour","cards.loss":"Pertes","cards.gap":"Plus long trou","cards.age":"Âge","cards.margin":"Marge d’énergie","cards.trips":"Coupures","cards.late":"Pas en retard","cards.temperature":"Température","cards.link":"Qualité du lien","cards.spark":"{quantity} de {seat} dans la dernière minute, maintenant {value}","quantity.force":"force (N)","quantity.rtt":"aller-retour (ms)","quantity.loss":"pertes (%)","quantity.margin":"marge d’énergie (J)","band.green":"vert : convient au contact raide et au mouvement rapide","band.amber":"orange : convient au mouvement lent et au contact doux","band.red":"rouge : hors des limites du retour d’effort","band.unknown":"pas de verdict","level.green":"bon","level.amber":"attention","level.red":"hors limite","level.unknown":"inconnu","gate.ON":"ouverte","gate.OFF":"fermée","gate.RISING":"en montée","gate.RELEASING":"en descente","gate.LATCHED":"verrouillée","gate.FAULT":"défaut","alarms.title":"Alarmes","alarms.none":"Aucune alarme.","alarms.lasting":"en cours","alarms.until":"jusqu’à {t}","alarm.stopped":"Session arrêtée par {seat}. {detail}","alarm.fault":"Défaut : {seat}. {detail}","alarm.lost":"Poste {seat} : pas de données de l’appareil.","alarm.gate":"Poste {seat} : la force est verrouillée.","alarm.clipping":"Poste {seat} : la force atteint la limite de l’appareil.","alarm.link":"Poste {seat} : lien rouge.","alarm.margin":"Poste {seat} : plus d’énergie, de l’amortissement s’ajoute.","alarm.trip":"Poste {seat} : la sécurité a coupé, {detail} en tout.","alarm.late":"Poste {seat} : pas en retard, {detail} en tout.","alarm.hot":"Poste {seat} : l’appareil est trop chaud.","alarm.shed":"Le serveur réduit la charge, niveau {detail}.","alarm.connection":"Pas de connexion avec la passerelle. {detail}","events.title":"Événements","events.none":"Aucun événement.","notices.title":"Messages","notices.dismiss":"Fermer","marks.title":"Chronologie","marks.note":"Note","marks.add":"Marquer maintenant","marks.at":"Marquer à {t}","marks.none":"Aucune marque.","marks.timeline":"Marques du début de la session à {t}","marks.placeholder":"ce qui s’est passé","sheet.title":"Fiches","sheet.kind":"Fiche","sheet.of":"Personne au poste","sheet.OSATS":"OSATS, évaluation globale","sheet.GEARS":"GEARS","sheet.GOALS":"GOALS","sheet.CHECKLIST":"Liste de contrôle","sheet.low":"1 = le plus bas, 5 = le plus haut","sheet.done":"Cochez ce qui a été fait.","sheet.total":"Total {points} sur {of}","sheet.missing":"{n} points sans note","sheet.optional":"facultatif","sheet.save":"Garder le brouillon","sheet.close":"Clore la fiche","sheet.closed":"Cette fiche est close. Elle ne peut plus changer.","sheet.closed_as_draft":"La fiche peut être close quand tous les points ont une note.","sheet.others":"Autres évaluateurs","sheet.hidden":"Les notes des autres évaluateurs apparaissent après la clôture de votre fiche.","sheet.no_others":"Aucun autre évaluateur n’a clos cette fiche.","item.respect_for_tissue":"Respect des tissus","item.time_and_motion":"Temps et mouvements","item.instrument_handling":"Maniement des instruments","item.knowledge_of_instruments":"Connaissance des instruments","item.use_of_assistants":"Usage des assistants","item.flow_and_forward_planning":"Déroulement et anticipation","item.knowledge_of_procedure":"Connaissance de la procédure","item.depth_perception":"Perception de la profondeur","item.bimanual_dexterity":"Dextérité des deux mains","item.efficiency":"Efficacité","item.force_sensitivity":"Sensibilité à la force","item.robotic_control":"Contrôle du robot","item.autonomy":"Autonomie","item.tissue_handling":"Traitement des tissus","item.device_checked":"Appareil vérifié avant la tâche","item.task_explained":"Tâche expliquée et comprise","item.contact_gentle":"Premier contact sans choc","item.target_reached":"Cible atteinte","item.no_force_limit":"Limite de force jamais atteinte","item.hand_over_clear":"Transfert annoncé et confirmé","seat.title":"Poste du navigateur","seat.choose":"Poste libre","seat.take":"Prendre le poste","seat.leave":"Quitter le poste","seat.none_free":"Aucun poste maître n’est libre.","seat.not_allowed":"La passerelle ou votre rôle ne permet pas de poste dans le navigateur.","seat.yours":"Vous avez le poste {seat}.","seat.pad":"Surface de la main. Tenez et tirez, ou utilisez les flèches ; espace tient et relâche.","seat.plane":"La surface montre","seat.front":"droite et haut","seat.above":"droite et avant","seat.depth_front":"Vers l’avant (mm)","seat.depth_above":"Vers le haut (mm)","seat.hold":"Tenir","seat.held":"Votre main tient l’appareil.","seat.released":"Votre main est relâchée. Appuyez sur la surface pour tenir l’appareil.","seat.force":"Force sur votre main","seat.gamepad":"Manette : stick gauche droite et haut, stick droit avant, premier bouton tient.","seat.gamepad_on":"Manette connectée.","seat.intended":"voulue","seat.actual":"réelle","seat.explain":"Le cercle en tirets est la position voulue, le cercle plein la position réelle. Le trait entre les deux est la force.","desk.title":"Nouvelle session","desk.scene":"Scène","desk.name":"Nom de la session","desk.people":"Personnes","desk.person":"Nom de la personne {n}","desk.role":"Rôle de la personne {n}","desk.seat":"Poste de la personne {n} (vide sans poste)","desk.add":"Ajouter une personne","desk.drop":"Retirer la personne {n}","desk.create":"Créer la session","desk.begins":"Une séance commence quand tous ses postes obligatoires sont pris.","desk.end":"Terminer la session","desk.tickets":"Billets de la session {name}","desk.ticket_of":"Billet de {person}","desk.single_use":"Chaque billet sert une fois. Donnez chaque lien à sa personne seulement.","desk.link":"Lien pour le navigateur","desk.step1":"Installer le client : apt install tandem-client.","desk.step2":"Brancher l’appareil et le vérifier : tandem-client doctor.","desk.step3":"Entrer avec le billet : tandem-client join --server SERVEUR --ticket-file FICHIER --seat {seat}.","desk.steps":"Avec un vrai appareil","desk.print":"Imprimer","desk.qr":"Code QR du lien pour {person}"},fh={en:Rd,fr:Qm};let dh="en";function Aa(i){dh=i}function tg(){return dh}function eg(i){for(const t of i){const e=Object.keys(fh).find(n=>t.toLowerCase().split("-")[0]===n);if(e)return e}return"en"}function H(i,t={}){return fh[dh][i].replace(/\{(\w+)\}/g,(e,n)=>Object.prototype.hasOwnProperty.call(t,n)?String(t[n]):e)}function ls(i,t){if(t===null||t==="")return"–";const e=`${i}.${t}`;return Object.prototype.hasOwnProperty.call(Rd,e)?H(e):t}const _u=10,ng=4401,ig=1e4;class sg{constructor(t){this.model=t,this.socket=null,this.pending=new km,this.backoff=new Om,this.budget=new Dm,this.onChange=()=>{},setInterval(()=>this.measure(),ig),setInterval(()=>{this.pending.expire(performance.now(),H("order.unanswered")),document.hidden&&this.acknowledge()},250),window.addEventListener("online",()=>this.connect())}connect(){if(clearTimeout(this.retry),this.socket&&this.socket.readyState<=WebSocket.OPEN)return;const t=new WebSocket(`${location.protocol==="https:"?"wss":"ws"}://${location.host}/live`);this.socket=t;let e=!1;t.onopen=()=>{e=!0,this.backoff.reset(),this.model.connected(),this.onChange()},t.onmessage=({data:n})=>{typeof n=="string"&&this.onFrame(n)},t.onclose=({code:n,reason:s})=>void this.onClose(t,e,n,s)}reconnect(){this.backoff.reset();const t=this.socket;this.socket=null,t?.close(),this.connect()}request(t){return new Promise(e=>{const n=r=>e({type:"reply",id:null,ok:!1,text:r});if(this.socket?.readyState!==WebSocket.OPEN)return n(H("order.no_connection"));if(!this.budget.take(performance.now()))return n(H("order.too_many"));const s=this.pending.add(performance.now(),(r,o)=>{t.type==="watch"&&this.model.states.addRoundTrip(o),e(r)});if(s===null)return n(H("order.too_many"));this.socket.send(JSON.stringify({...t,id:s}))})}signal(t,e=!1){this.socket?.readyState===WebSocket.OPEN&&this.budget.take(performance.now(),e?0:_u)&&this.socket.send(JSON.stringify(t))}acknowledge(){if(this.socket?.readyState!==WebSocket.OPEN||!this.model.acknowledgements.due||!this.budget.take(performance.now(),_u))return;const t=this.model.acknowledgements.next();t!==null&&this.socket.send(JSON.stringify({type:"ack",n:t}))}onFrame(t){const e=Jm(t);if(!e)return;const n=performance.now(),s=this.model.scene?.session;this.model.apply(e,n),e.type==="reply"&&!this.pending.reply(e,n)&&!e.ok&&this.model.apply({type:"notice",level:"error",text:e.text},n),e.type==="hello"&&this.watchAgain(s),e.type!=="state"&&e.type!=="seat"&&this.onChange()}watchAgain(t){const e=this.model.hello?.sessions??[],n=e.find(({id:s})=>s===t)??e[0];n&&this.request({type:"watch",session:n.id}),setTimeout(()=>this.measure(),1500)}measure(){const t=this.model.scene?.session;t&&this.model.link==="open"&&!document.hidden&&this.request({type:"watch",session:t})}async onClose(t,e,n,s){if(this.socket!==t)return;this.socket=null,this.pending.failAll(H("order.no_connection"));const r=s||`WebSocket ${n}`,o=n===ng||!e&&await rg();this.model.disconnected(o?"refused":"lost",r),this.onChange(),this.model.link==="lost"&&(this.retry=setTimeout(()=>this.connect(),this.backoff.next(Math.random())))}}async function rg(){try{return(await fetch("/healthz",{cache:"no-store"})).ok}catch{return!1}}const og=/^[A-Za-z0-9_-]{1,32}$/,ag=["INSTRUCTOR","TRAINEE","EVALUATOR","OBSERVER"];function Oo(i){return og.test(i)}function lg(i){const t=[];Oo(i.scene)||t.push({field:"scene",index:null}),Oo(i.name)||t.push({field:"name",index:null}),i.people.length>2*xo&&t.push({field:"people",index:null});const e=new Set,n=new Set;return i.people.forEach((s,r)=>{(!Oo(s.name)||e.has(s.name))&&t.push({field:"person",index:r}),s.seat!==""&&(!Oo(s.seat)||n.has(s.seat))&&t.push({field:"seat",index:r}),e.add(s.name),s.seat!==""&&n.add(s.seat)}),t}function cg(i,t){return`${i}/#ticket=${encodeURIComponent(t.ticket)}&name=${encodeURIComponent(t.person)}`}function hg(i){const t=new URLSearchParams(i.replace(/^#/,"")),e=t.get("ticket");return e?{ticket:e.slice(0,4096),name:(t.get("name")??"").slice(0,64)}:null}function z(i,t={},...e){const n=document.createElement(i);return Cd(n,t),n.append(...e.filter(s=>s!==null)),n}function Si(i,t={},...e){const n=document.createElementNS("http://www.w3.org/2000/svg",i);return Cd(n,t),n.append(...e.filter(s=>s!==null)),n}function Cd(i,t){for(const[e,n]of Object.entries(t))typeof n=="function"?i.addEventListener(e.slice(2),n):n===!0?i.setAttribute(e,""):n!==!1&&n!==void 0&&i.setAttribute(e,String(n))}function Se(i,t){i.textContent!==t&&(i.textContent=t)}function rs(i,t,e){i.getAttribute(t)!==e&&(e===null?i.removeAttribute(t):i.setAttribute(t,e))}function Te(i,t){i.disabled!==t&&(i.disabled=t)}function qe(i,t){return z("label",{class:"field"},z("span",{},i),t)}function ti(i,t,e){const n=z("select",{onchange:()=>e(n.value)});return Us(n,i,t),n}function Us(i,t,e){i.replaceChildren(...t.map(([n,s])=>z("option",{value:n},s))),t.some(([n])=>n===e)&&(i.value=e)}function Fe(i,t,e={}){return z("button",{type:"button",onclick:t,...e},i)}function uc(i,t,e){const n=z("input",{type:"checkbox",onchange:()=>e(n.checked)});return n.checked=t,z("label",{class:"check"},n,z("span",{},i))}function Vn(i,t,...e){const n=z("h2",{id:`${t}-title`},i);return z("section",{class:`panel ${t}`,"aria-labelledby":n.id},n,...e)}function vu(i,t,e,n,s,r){return new Promise(o=>{const a=z("button",{type:"submit",value:"go",class:"danger"},s),l=z("h2",{id:"dialog-title"},i),c=z("dialog",{"aria-labelledby":l.id,onclose:()=>{c.remove(),o(c.returnValue==="go"?e.value:null)}},z("form",{method:"dialog"},l,t?z("p",{},t):null,qe(n,e),z("div",{class:"row"},a,z("button",{type:"submit",value:"cancel",formnovalidate:!0},r))));document.body.append(c),c.showModal()})}class ug{constructor(t){this.page=t,this.active=z("p",{class:"active-stop",role:"status"}),this.stop=Fe(H("stop.stop"),()=>this.order("stop"),{class:"stop","aria-keyshortcuts":"S"}),this.pause=Fe(H("stop.pause"),()=>this.order("pause"),{class:"pause","aria-keyshortcuts":"P"}),this.resume=Fe(H("stop.resume"),()=>this.order("resume"),{class:"resume","aria-keyshortcuts":"R"}),this.node=z("div",{class:"control-bar"},this.stop,this.pause,this.resume,this.active)}order(t){const{model:e}=this.page,n=H(`stop.${t}`);if(!e.granted(t)){this.page.report("warning",H("order.refused",{what:n,why:H("order.not_allowed")}));return}const s=e.state?.stop;if(t==="resume"&&!s)return;const r=t==="resume"?{order:t,stop:s?.number??0}:{order:t,why:H("stop.why")};this.page.order(n,r)}update(){const{model:t}=this.page,e=t.state,n=["stop","pause","resume"].some(a=>t.granted(a)),s=e?.stop??null;this.node.hidden=!n&&!s;for(const[a,l]of[[this.stop,"stop"],[this.pause,"pause"],[this.resume,"resume"]])a.hidden=!t.granted(l);const r=e?.phase==="OVER";Te(this.stop,!t.may("stop")||r||s?.kind==="STOP"),Te(this.pause,!t.may("pause")||r||s!==null),Te(this.resume,!t.may("resume")||s===null||!s.yours),this.node.classList.toggle("stopped",s!==null);const o=s?H("stop.active",{kind:ls("stop.kind",s.kind),by:s.by||"–",why:s.why||H("stop.no_reason")})+(s.yours||!t.granted("resume")?"":` ${H("stop.not_yours")}`):"";Se(this.active,o),this.active.hidden=o===""}}function fg(i){return i&&i.__esModule&&Object.prototype.hasOwnProperty.call(i,"default")?i.default:i}var Pd={exports:{}};(function(i,t){var e=function(){var n=function(D,A){var y=236,P=17,O=D,g=r[A],m=null,E=0,N=null,F=[],B={},G=function(Z,J){E=O*4+17,m=function(Y){for(var ot=new Array(Y),at=0;at<Y;at+=1){ot[at]=new Array(Y);for(var I=0;I<Y;I+=1)ot[at][I]=null}return ot}(E),K(0,0),K(E-7,0),K(0,E-7),ct(),dt(),xt(Z,J),O>=7&&gt(Z),N==null&&(N=pt(O,g,F)),Vt(N,J)},K=function(Z,J){for(var Y=-1;Y<=7;Y+=1)if(!(Z+Y<=-1||E<=Z+Y))for(var ot=-1;ot<=7;ot+=1)J+ot<=-1||E<=J+ot||(0<=Y&&Y<=6&&(ot==0||ot==6)||0<=ot&&ot<=6&&(Y==0||Y==6)||2<=Y&&Y<=4&&2<=ot&&ot<=4?m[Z+Y][J+ot]=!0:m[Z+Y][J+ot]=!1)},Q=function(){for(var Z=0,J=0,Y=0;Y<8;Y+=1){G(!0,Y);var ot=a.getLostPoint(B);(Y==0||Z>ot)&&(Z=ot,J=Y)}return J},dt=function(){for(var Z=8;Z<E-8;Z+=1)m[Z][6]==null&&(m[Z][6]=Z%2==0);for(var J=8;J<E-8;J+=1)m[6][J]==null&&(m[6][J]=J%2==0)},ct=function(){for(var Z=a.getPatternPosition(O),J=0;J<Z.length;J+=1)for(var Y=0;Y<Z.length;Y+=1){var ot=Z[J],at=Z[Y];if(m[ot][at]==null)for(var I=-2;I<=2;I+=1)for(var Ot=-2;Ot<=2;Ot+=1)I==-2||I==2||Ot==-2||Ot==2||I==0&&Ot==0?m[ot+I][at+Ot]=!0:m[ot+I][at+Ot]=!1}},gt=function(Z){for(var J=a.getBCHTypeNumber(O),Y=0;Y<18;Y+=1){var ot=!Z&&(J>>Y&1)==1;m[Math.floor(Y/3)][Y%3+E-8-3]=ot}for(var Y=0;Y<18;Y+=1){var ot=!Z&&(J>>Y&1)==1;m[Y%3+E-8-3][Math.floor(Y/3)]=ot}},xt=function(Z,J){for(var Y=g<<3|J,ot=a.getBCHTypeInfo(Y),at=0;at<15;at+=1){var I=!Z&&(ot>>at&1)==1;at<6?m[at][8]=I:at<8?m[at+1][8]=I:m[E-15+at][8]=I}for(var at=0;at<15;at+=1){var I=!Z&&(ot>>at&1)==1;at<8?m[8][E-at-1]=I:at<9?m[8][15-at-1+1]=I:m[8][15-at-1]=I}m[E-8][8]=!Z},Vt=function(Z,J){for(var Y=-1,ot=E-1,at=7,I=0,Ot=a.getMaskFunction(J),Mt=E-1;Mt>0;Mt-=2)for(Mt==6&&(Mt-=1);;){for(var Ht=0;Ht<2;Ht+=1)if(m[ot][Mt-Ht]==null){var At=!1;I<Z.length&&(At=(Z[I]>>>at&1)==1);var Et=Ot(ot,Mt-Ht);Et&&(At=!At),m[ot][Mt-Ht]=At,at-=1,at==-1&&(I+=1,at=7)}if(ot+=Y,ot<0||E<=ot){ot-=Y,Y=-Y;break}}},rt=function(Z,J){for(var Y=0,ot=0,at=0,I=new Array(J.length),Ot=new Array(J.length),Mt=0;Mt<J.length;Mt+=1){var Ht=J[Mt].dataCount,At=J[Mt].totalCount-Ht;ot=Math.max(ot,Ht),at=Math.max(at,At),I[Mt]=new Array(Ht);for(var Et=0;Et<I[Mt].length;Et+=1)I[Mt][Et]=255&Z.getBuffer()[Et+Y];Y+=Ht;var Xt=a.getErrorCorrectPolynomial(At),L=c(I[Mt],Xt.getLength()-1),w=L.mod(Xt);Ot[Mt]=new Array(Xt.getLength()-1);for(var Et=0;Et<Ot[Mt].length;Et+=1){var V=Et+w.getLength()-Ot[Mt].length;Ot[Mt][Et]=V>=0?w.getAt(V):0}}for(var it=0,Et=0;Et<J.length;Et+=1)it+=J[Et].totalCount;for(var ht=new Array(it),nt=0,Et=0;Et<ot;Et+=1)for(var Mt=0;Mt<J.length;Mt+=1)Et<I[Mt].length&&(ht[nt]=I[Mt][Et],nt+=1);for(var Et=0;Et<at;Et+=1)for(var Mt=0;Mt<J.length;Mt+=1)Et<Ot[Mt].length&&(ht[nt]=Ot[Mt][Et],nt+=1);return ht},pt=function(Z,J,Y){for(var ot=u.getRSBlocks(Z,J),at=f(),I=0;I<Y.length;I+=1){var Ot=Y[I];at.put(Ot.getMode(),4),at.put(Ot.getLength(),a.getLengthInBits(Ot.getMode(),Z)),Ot.write(at)}for(var Mt=0,I=0;I<ot.length;I+=1)Mt+=ot[I].dataCount;if(at.getLengthInBits()>Mt*8)throw"code length overflow. ("+at.getLengthInBits()+">"+Mt*8+")";for(at.getLengthInBits()+4<=Mt*8&&at.put(0,4);at.getLengthInBits()%8!=0;)at.putBit(!1);for(;!(at.getLengthInBits()>=Mt*8||(at.put(y,8),at.getLengthInBits()>=Mt*8));)at.put(P,8);return rt(at,ot)};B.addData=function(Z,J){J=J||"Byte";var Y=null;switch(J){case"Numeric":Y=h(Z);break;case"Alphanumeric":Y=_(Z);break;case"Byte":Y=x(Z);break;case"Kanji":Y=M(Z);break;default:throw"mode:"+J}F.push(Y),N=null},B.isDark=function(Z,J){if(Z<0||E<=Z||J<0||E<=J)throw Z+","+J;return m[Z][J]},B.getModuleCount=function(){return E},B.make=function(){if(O<1){for(var Z=1;Z<40;Z++){for(var J=u.getRSBlocks(Z,g),Y=f(),ot=0;ot<F.length;ot++){var at=F[ot];Y.put(at.getMode(),4),Y.put(at.getLength(),a.getLengthInBits(at.getMode(),Z)),at.write(Y)}for(var I=0,ot=0;ot<J.length;ot++)I+=J[ot].dataCount;if(Y.getLengthInBits()<=I*8)break}O=Z}G(!1,Q())},B.createTableTag=function(Z,J){Z=Z||2,J=typeof J>"u"?Z*4:J;var Y="";Y+='<table style="',Y+=" border-width: 0px; border-style: none;",Y+=" border-collapse: collapse;",Y+=" padding: 0px; margin: "+J+"px;",Y+='">',Y+="<tbody>";for(var ot=0;ot<B.getModuleCount();ot+=1){Y+="<tr>";for(var at=0;at<B.getModuleCount();at+=1)Y+='<td style="',Y+=" border-width: 0px; border-style: none;",Y+=" border-collapse: collapse;",Y+=" padding: 0px; margin: 0px;",Y+=" width: "+Z+"px;",Y+=" height: "+Z+"px;",Y+=" background-color: ",Y+=B.isDark(ot,at)?"#000000":"#ffffff",Y+=";",Y+='"/>';Y+="</tr>"}return Y+="</tbody>",Y+="</table>",Y},B.createSvgTag=function(Z,J,Y,ot){var at={};typeof arguments[0]=="object"&&(at=arguments[0],Z=at.cellSize,J=at.margin,Y=at.alt,ot=at.title),Z=Z||2,J=typeof J>"u"?Z*4:J,Y=typeof Y=="string"?{text:Y}:Y||{},Y.text=Y.text||null,Y.id=Y.text?Y.id||"qrcode-description":null,ot=typeof ot=="string"?{text:ot}:ot||{},ot.text=ot.text||null,ot.id=ot.text?ot.id||"qrcode-title":null;var I=B.getModuleCount()*Z+J*2,Ot,Mt,Ht,At,Et="",Xt;for(Xt="l"+Z+",0 0,"+Z+" -"+Z+",0 0,-"+Z+"z ",Et+='<svg version="1.1" xmlns="http://www.w3.org/2000/svg"',Et+=at.scalable?"":' width="'+I+'px" height="'+I+'px"',Et+=' viewBox="0 0 '+I+" "+I+'" ',Et+=' preserveAspectRatio="xMinYMin meet"',Et+=ot.text||Y.text?' role="img" aria-labelledby="'+Dt([ot.id,Y.id].join(" ").trim())+'"':"",Et+=">",Et+=ot.text?'<title id="'+Dt(ot.id)+'">'+Dt(ot.text)+"</title>":"",Et+=Y.text?'<description id="'+Dt(Y.id)+'">'+Dt(Y.text)+"</description>":"",Et+='<rect width="100%" height="100%" fill="white" cx="0" cy="0"/>',Et+='<path d="',Ht=0;Ht<B.getModuleCount();Ht+=1)for(At=Ht*Z+J,Ot=0;Ot<B.getModuleCount();Ot+=1)B.isDark(Ht,Ot)&&(Mt=Ot*Z+J,Et+="M"+Mt+","+At+Xt);return Et+='" stroke="transparent" fill="black"/>',Et+="</svg>",Et},B.createDataURL=function(Z,J){Z=Z||2,J=typeof J>"u"?Z*4:J;var Y=B.getModuleCount()*Z+J*2,ot=J,at=Y-J;return R(Y,Y,function(I,Ot){if(ot<=I&&I<at&&ot<=Ot&&Ot<at){var Mt=Math.floor((I-ot)/Z),Ht=Math.floor((Ot-ot)/Z);return B.isDark(Ht,Mt)?0:1}else return 1})},B.createImgTag=function(Z,J,Y){Z=Z||2,J=typeof J>"u"?Z*4:J;var ot=B.getModuleCount()*Z+J*2,at="";return at+="<img",at+=' src="',at+=B.createDataURL(Z,J),at+='"',at+=' width="',at+=ot,at+='"',at+=' height="',at+=ot,at+='"',Y&&(at+=' alt="',at+=Dt(Y),at+='"'),at+="/>",at};var Dt=function(Z){for(var J="",Y=0;Y<Z.length;Y+=1){var ot=Z.charAt(Y);switch(ot){case"<":J+="&lt;";break;case">":J+="&gt;";break;case"&":J+="&amp;";break;case'"':J+="&quot;";break;default:J+=ot;break}}return J},St=function(Z){var J=1;Z=typeof Z>"u"?J*2:Z;var Y=B.getModuleCount()*J+Z*2,ot=Z,at=Y-Z,I,Ot,Mt,Ht,At,Et={"██":"█","█ ":"▀"," █":"▄","  ":" "},Xt={"██":"▀","█ ":"▀"," █":" ","  ":" "},L="";for(I=0;I<Y;I+=2){for(Mt=Math.floor((I-ot)/J),Ht=Math.floor((I+1-ot)/J),Ot=0;Ot<Y;Ot+=1)At="█",ot<=Ot&&Ot<at&&ot<=I&&I<at&&B.isDark(Mt,Math.floor((Ot-ot)/J))&&(At=" "),ot<=Ot&&Ot<at&&ot<=I+1&&I+1<at&&B.isDark(Ht,Math.floor((Ot-ot)/J))?At+=" ":At+="█",L+=Z<1&&I+1>=at?Xt[At]:Et[At];L+=`
`}return Y%2&&Z>0?L.substring(0,L.length-Y-1)+Array(Y+1).join("▀"):L.substring(0,L.length-1)};return B.createASCII=function(Z,J){if(Z=Z||1,Z<2)return St(J);Z-=1,J=typeof J>"u"?Z*2:J;var Y=B.getModuleCount()*Z+J*2,ot=J,at=Y-J,I,Ot,Mt,Ht,At=Array(Z+1).join("██"),Et=Array(Z+1).join("  "),Xt="",L="";for(I=0;I<Y;I+=1){for(Mt=Math.floor((I-ot)/Z),L="",Ot=0;Ot<Y;Ot+=1)Ht=1,ot<=Ot&&Ot<at&&ot<=I&&I<at&&B.isDark(Mt,Math.floor((Ot-ot)/Z))&&(Ht=0),L+=Ht?At:Et;for(Mt=0;Mt<Z;Mt+=1)Xt+=L+`
`}return Xt.substring(0,Xt.length-1)},B.renderTo2dContext=function(Z,J){J=J||2;for(var Y=B.getModuleCount(),ot=0;ot<Y;ot++)for(var at=0;at<Y;at++)Z.fillStyle=B.isDark(ot,at)?"black":"white",Z.fillRect(ot*J,at*J,J,J)},B};n.stringToBytesFuncs={default:function(D){for(var A=[],y=0;y<D.length;y+=1){var P=D.charCodeAt(y);A.push(P&255)}return A}},n.stringToBytes=n.stringToBytesFuncs.default,n.createStringToBytes=function(D,A){var y=function(){for(var O=C(D),g=function(){var dt=O.read();if(dt==-1)throw"eof";return dt},m=0,E={};;){var N=O.read();if(N==-1)break;var F=g(),B=g(),G=g(),K=String.fromCharCode(N<<8|F),Q=B<<8|G;E[K]=Q,m+=1}if(m!=A)throw m+" != "+A;return E}(),P=63;return function(O){for(var g=[],m=0;m<O.length;m+=1){var E=O.charCodeAt(m);if(E<128)g.push(E);else{var N=y[O.charAt(m)];typeof N=="number"?(N&255)==N?g.push(N):(g.push(N>>>8),g.push(N&255)):g.push(P)}}return g}};var s={MODE_NUMBER:1,MODE_ALPHA_NUM:2,MODE_8BIT_BYTE:4,MODE_KANJI:8},r={L:1,M:0,Q:3,H:2},o={PATTERN000:0,PATTERN001:1,PATTERN010:2,PATTERN011:3,PATTERN100:4,PATTERN101:5,PATTERN110:6,PATTERN111:7},a=function(){var D=[[],[6,18],[6,22],[6,26],[6,30],[6,34],[6,22,38],[6,24,42],[6,26,46],[6,28,50],[6,30,54],[6,32,58],[6,34,62],[6,26,46,66],[6,26,48,70],[6,26,50,74],[6,30,54,78],[6,30,56,82],[6,30,58,86],[6,34,62,90],[6,28,50,72,94],[6,26,50,74,98],[6,30,54,78,102],[6,28,54,80,106],[6,32,58,84,110],[6,30,58,86,114],[6,34,62,90,118],[6,26,50,74,98,122],[6,30,54,78,102,126],[6,26,52,78,104,130],[6,30,56,82,108,134],[6,34,60,86,112,138],[6,30,58,86,114,142],[6,34,62,90,118,146],[6,30,54,78,102,126,150],[6,24,50,76,102,128,154],[6,28,54,80,106,132,158],[6,32,58,84,110,136,162],[6,26,54,82,110,138,166],[6,30,58,86,114,142,170]],A=1335,y=7973,P=21522,O={},g=function(m){for(var E=0;m!=0;)E+=1,m>>>=1;return E};return O.getBCHTypeInfo=function(m){for(var E=m<<10;g(E)-g(A)>=0;)E^=A<<g(E)-g(A);return(m<<10|E)^P},O.getBCHTypeNumber=function(m){for(var E=m<<12;g(E)-g(y)>=0;)E^=y<<g(E)-g(y);return m<<12|E},O.getPatternPosition=function(m){return D[m-1]},O.getMaskFunction=function(m){switch(m){case o.PATTERN000:return function(E,N){return(E+N)%2==0};case o.PATTERN001:return function(E,N){return E%2==0};case o.PATTERN010:return function(E,N){return N%3==0};case o.PATTERN011:return function(E,N){return(E+N)%3==0};case o.PATTERN100:return function(E,N){return(Math.floor(E/2)+Math.floor(N/3))%2==0};case o.PATTERN101:return function(E,N){return E*N%2+E*N%3==0};case o.PATTERN110:return function(E,N){return(E*N%2+E*N%3)%2==0};case o.PATTERN111:return function(E,N){return(E*N%3+(E+N)%2)%2==0};default:throw"bad maskPattern:"+m}},O.getErrorCorrectPolynomial=function(m){for(var E=c([1],0),N=0;N<m;N+=1)E=E.multiply(c([1,l.gexp(N)],0));return E},O.getLengthInBits=function(m,E){if(1<=E&&E<10)switch(m){case s.MODE_NUMBER:return 10;case s.MODE_ALPHA_NUM:return 9;case s.MODE_8BIT_BYTE:return 8;case s.MODE_KANJI:return 8;default:throw"mode:"+m}else if(E<27)switch(m){case s.MODE_NUMBER:return 12;case s.MODE_ALPHA_NUM:return 11;case s.MODE_8BIT_BYTE:return 16;case s.MODE_KANJI:return 10;default:throw"mode:"+m}else if(E<41)switch(m){case s.MODE_NUMBER:return 14;case s.MODE_ALPHA_NUM:return 13;case s.MODE_8BIT_BYTE:return 16;case s.MODE_KANJI:return 12;default:throw"mode:"+m}else throw"type:"+E},O.getLostPoint=function(m){for(var E=m.getModuleCount(),N=0,F=0;F<E;F+=1)for(var B=0;B<E;B+=1){for(var G=0,K=m.isDark(F,B),Q=-1;Q<=1;Q+=1)if(!(F+Q<0||E<=F+Q))for(var dt=-1;dt<=1;dt+=1)B+dt<0||E<=B+dt||Q==0&&dt==0||K==m.isDark(F+Q,B+dt)&&(G+=1);G>5&&(N+=3+G-5)}for(var F=0;F<E-1;F+=1)for(var B=0;B<E-1;B+=1){var ct=0;m.isDark(F,B)&&(ct+=1),m.isDark(F+1,B)&&(ct+=1),m.isDark(F,B+1)&&(ct+=1),m.isDark(F+1,B+1)&&(ct+=1),(ct==0||ct==4)&&(N+=3)}for(var F=0;F<E;F+=1)for(var B=0;B<E-6;B+=1)m.isDark(F,B)&&!m.isDark(F,B+1)&&m.isDark(F,B+2)&&m.isDark(F,B+3)&&m.isDark(F,B+4)&&!m.isDark(F,B+5)&&m.isDark(F,B+6)&&(N+=40);for(var B=0;B<E;B+=1)for(var F=0;F<E-6;F+=1)m.isDark(F,B)&&!m.isDark(F+1,B)&&m.isDark(F+2,B)&&m.isDark(F+3,B)&&m.isDark(F+4,B)&&!m.isDark(F+5,B)&&m.isDark(F+6,B)&&(N+=40);for(var gt=0,B=0;B<E;B+=1)for(var F=0;F<E;F+=1)m.isDark(F,B)&&(gt+=1);var xt=Math.abs(100*gt/E/E-50)/5;return N+=xt*10,N},O}(),l=function(){for(var D=new Array(256),A=new Array(256),y=0;y<8;y+=1)D[y]=1<<y;for(var y=8;y<256;y+=1)D[y]=D[y-4]^D[y-5]^D[y-6]^D[y-8];for(var y=0;y<255;y+=1)A[D[y]]=y;var P={};return P.glog=function(O){if(O<1)throw"glog("+O+")";return A[O]},P.gexp=function(O){for(;O<0;)O+=255;for(;O>=256;)O-=255;return D[O]},P}();function c(D,A){if(typeof D.length>"u")throw D.length+"/"+A;var y=function(){for(var O=0;O<D.length&&D[O]==0;)O+=1;for(var g=new Array(D.length-O+A),m=0;m<D.length-O;m+=1)g[m]=D[m+O];return g}(),P={};return P.getAt=function(O){return y[O]},P.getLength=function(){return y.length},P.multiply=function(O){for(var g=new Array(P.getLength()+O.getLength()-1),m=0;m<P.getLength();m+=1)for(var E=0;E<O.getLength();E+=1)g[m+E]^=l.gexp(l.glog(P.getAt(m))+l.glog(O.getAt(E)));return c(g,0)},P.mod=function(O){if(P.getLength()-O.getLength()<0)return P;for(var g=l.glog(P.getAt(0))-l.glog(O.getAt(0)),m=new Array(P.getLength()),E=0;E<P.getLength();E+=1)m[E]=P.getAt(E);for(var E=0;E<O.getLength();E+=1)m[E]^=l.gexp(l.glog(O.getAt(E))+g);return c(m,0).mod(O)},P}var u=function(){var D=[[1,26,19],[1,26,16],[1,26,13],[1,26,9],[1,44,34],[1,44,28],[1,44,22],[1,44,16],[1,70,55],[1,70,44],[2,35,17],[2,35,13],[1,100,80],[2,50,32],[2,50,24],[4,25,9],[1,134,108],[2,67,43],[2,33,15,2,34,16],[2,33,11,2,34,12],[2,86,68],[4,43,27],[4,43,19],[4,43,15],[2,98,78],[4,49,31],[2,32,14,4,33,15],[4,39,13,1,40,14],[2,121,97],[2,60,38,2,61,39],[4,40,18,2,41,19],[4,40,14,2,41,15],[2,146,116],[3,58,36,2,59,37],[4,36,16,4,37,17],[4,36,12,4,37,13],[2,86,68,2,87,69],[4,69,43,1,70,44],[6,43,19,2,44,20],[6,43,15,2,44,16],[4,101,81],[1,80,50,4,81,51],[4,50,22,4,51,23],[3,36,12,8,37,13],[2,116,92,2,117,93],[6,58,36,2,59,37],[4,46,20,6,47,21],[7,42,14,4,43,15],[4,133,107],[8,59,37,1,60,38],[8,44,20,4,45,21],[12,33,11,4,34,12],[3,145,115,1,146,116],[4,64,40,5,65,41],[11,36,16,5,37,17],[11,36,12,5,37,13],[5,109,87,1,110,88],[5,65,41,5,66,42],[5,54,24,7,55,25],[11,36,12,7,37,13],[5,122,98,1,123,99],[7,73,45,3,74,46],[15,43,19,2,44,20],[3,45,15,13,46,16],[1,135,107,5,136,108],[10,74,46,1,75,47],[1,50,22,15,51,23],[2,42,14,17,43,15],[5,150,120,1,151,121],[9,69,43,4,70,44],[17,50,22,1,51,23],[2,42,14,19,43,15],[3,141,113,4,142,114],[3,70,44,11,71,45],[17,47,21,4,48,22],[9,39,13,16,40,14],[3,135,107,5,136,108],[3,67,41,13,68,42],[15,54,24,5,55,25],[15,43,15,10,44,16],[4,144,116,4,145,117],[17,68,42],[17,50,22,6,51,23],[19,46,16,6,47,17],[2,139,111,7,140,112],[17,74,46],[7,54,24,16,55,25],[34,37,13],[4,151,121,5,152,122],[4,75,47,14,76,48],[11,54,24,14,55,25],[16,45,15,14,46,16],[6,147,117,4,148,118],[6,73,45,14,74,46],[11,54,24,16,55,25],[30,46,16,2,47,17],[8,132,106,4,133,107],[8,75,47,13,76,48],[7,54,24,22,55,25],[22,45,15,13,46,16],[10,142,114,2,143,115],[19,74,46,4,75,47],[28,50,22,6,51,23],[33,46,16,4,47,17],[8,152,122,4,153,123],[22,73,45,3,74,46],[8,53,23,26,54,24],[12,45,15,28,46,16],[3,147,117,10,148,118],[3,73,45,23,74,46],[4,54,24,31,55,25],[11,45,15,31,46,16],[7,146,116,7,147,117],[21,73,45,7,74,46],[1,53,23,37,54,24],[19,45,15,26,46,16],[5,145,115,10,146,116],[19,75,47,10,76,48],[15,54,24,25,55,25],[23,45,15,25,46,16],[13,145,115,3,146,116],[2,74,46,29,75,47],[42,54,24,1,55,25],[23,45,15,28,46,16],[17,145,115],[10,74,46,23,75,47],[10,54,24,35,55,25],[19,45,15,35,46,16],[17,145,115,1,146,116],[14,74,46,21,75,47],[29,54,24,19,55,25],[11,45,15,46,46,16],[13,145,115,6,146,116],[14,74,46,23,75,47],[44,54,24,7,55,25],[59,46,16,1,47,17],[12,151,121,7,152,122],[12,75,47,26,76,48],[39,54,24,14,55,25],[22,45,15,41,46,16],[6,151,121,14,152,122],[6,75,47,34,76,48],[46,54,24,10,55,25],[2,45,15,64,46,16],[17,152,122,4,153,123],[29,74,46,14,75,47],[49,54,24,10,55,25],[24,45,15,46,46,16],[4,152,122,18,153,123],[13,74,46,32,75,47],[48,54,24,14,55,25],[42,45,15,32,46,16],[20,147,117,4,148,118],[40,75,47,7,76,48],[43,54,24,22,55,25],[10,45,15,67,46,16],[19,148,118,6,149,119],[18,75,47,31,76,48],[34,54,24,34,55,25],[20,45,15,61,46,16]],A=function(O,g){var m={};return m.totalCount=O,m.dataCount=g,m},y={},P=function(O,g){switch(g){case r.L:return D[(O-1)*4+0];case r.M:return D[(O-1)*4+1];case r.Q:return D[(O-1)*4+2];case r.H:return D[(O-1)*4+3];default:return}};return y.getRSBlocks=function(O,g){var m=P(O,g);if(typeof m>"u")throw"bad rs block @ typeNumber:"+O+"/errorCorrectionLevel:"+g;for(var E=m.length/3,N=[],F=0;F<E;F+=1)for(var B=m[F*3+0],G=m[F*3+1],K=m[F*3+2],Q=0;Q<B;Q+=1)N.push(A(G,K));return N},y}(),f=function(){var D=[],A=0,y={};return y.getBuffer=function(){return D},y.getAt=function(P){var O=Math.floor(P/8);return(D[O]>>>7-P%8&1)==1},y.put=function(P,O){for(var g=0;g<O;g+=1)y.putBit((P>>>O-g-1&1)==1)},y.getLengthInBits=function(){return A},y.putBit=function(P){var O=Math.floor(A/8);D.length<=O&&D.push(0),P&&(D[O]|=128>>>A%8),A+=1},y},h=function(D){var A=s.MODE_NUMBER,y=D,P={};P.getMode=function(){return A},P.getLength=function(m){return y.length},P.write=function(m){for(var E=y,N=0;N+2<E.length;)m.put(O(E.substring(N,N+3)),10),N+=3;N<E.length&&(E.length-N==1?m.put(O(E.substring(N,N+1)),4):E.length-N==2&&m.put(O(E.substring(N,N+2)),7))};var O=function(m){for(var E=0,N=0;N<m.length;N+=1)E=E*10+g(m.charAt(N));return E},g=function(m){if("0"<=m&&m<="9")return m.charCodeAt(0)-48;throw"illegal char :"+m};return P},_=function(D){var A=s.MODE_ALPHA_NUM,y=D,P={};P.getMode=function(){return A},P.getLength=function(g){return y.length},P.write=function(g){for(var m=y,E=0;E+1<m.length;)g.put(O(m.charAt(E))*45+O(m.charAt(E+1)),11),E+=2;E<m.length&&g.put(O(m.charAt(E)),6)};var O=function(g){if("0"<=g&&g<="9")return g.charCodeAt(0)-48;if("A"<=g&&g<="Z")return g.charCodeAt(0)-65+10;switch(g){case" ":return 36;case"$":return 37;case"%":return 38;case"*":return 39;case"+":return 40;case"-":return 41;case".":return 42;case"/":return 43;case":":return 44;default:throw"illegal char :"+g}};return P},x=function(D){var A=s.MODE_8BIT_BYTE,y=n.stringToBytes(D),P={};return P.getMode=function(){return A},P.getLength=function(O){return y.length},P.write=function(O){for(var g=0;g<y.length;g+=1)O.put(y[g],8)},P},M=function(D){var A=s.MODE_KANJI,y=n.stringToBytesFuncs.SJIS;if(!y)throw"sjis not supported.";(function(g,m){var E=y(g);if(E.length!=2||(E[0]<<8|E[1])!=m)throw"sjis not supported."})("友",38726);var P=y(D),O={};return O.getMode=function(){return A},O.getLength=function(g){return~~(P.length/2)},O.write=function(g){for(var m=P,E=0;E+1<m.length;){var N=(255&m[E])<<8|255&m[E+1];if(33088<=N&&N<=40956)N-=33088;else if(57408<=N&&N<=60351)N-=49472;else throw"illegal char at "+(E+1)+"/"+N;N=(N>>>8&255)*192+(N&255),g.put(N,13),E+=2}if(E<m.length)throw"illegal char at "+(E+1)},O},p=function(){var D=[],A={};return A.writeByte=function(y){D.push(y&255)},A.writeShort=function(y){A.writeByte(y),A.writeByte(y>>>8)},A.writeBytes=function(y,P,O){P=P||0,O=O||y.length;for(var g=0;g<O;g+=1)A.writeByte(y[g+P])},A.writeString=function(y){for(var P=0;P<y.length;P+=1)A.writeByte(y.charCodeAt(P))},A.toByteArray=function(){return D},A.toString=function(){var y="";y+="[";for(var P=0;P<D.length;P+=1)P>0&&(y+=","),y+=D[P];return y+="]",y},A},d=function(){var D=0,A=0,y=0,P="",O={},g=function(E){P+=String.fromCharCode(m(E&63))},m=function(E){if(!(E<0)){if(E<26)return 65+E;if(E<52)return 97+(E-26);if(E<62)return 48+(E-52);if(E==62)return 43;if(E==63)return 47}throw"n:"+E};return O.writeByte=function(E){for(D=D<<8|E&255,A+=8,y+=1;A>=6;)g(D>>>A-6),A-=6},O.flush=function(){if(A>0&&(g(D<<6-A),D=0,A=0),y%3!=0)for(var E=3-y%3,N=0;N<E;N+=1)P+="="},O.toString=function(){return P},O},C=function(D){var A=D,y=0,P=0,O=0,g={};g.read=function(){for(;O<8;){if(y>=A.length){if(O==0)return-1;throw"unexpected end of file./"+O}var E=A.charAt(y);if(y+=1,E=="=")return O=0,-1;if(E.match(/^\s$/))continue;P=P<<6|m(E.charCodeAt(0)),O+=6}var N=P>>>O-8&255;return O-=8,N};var m=function(E){if(65<=E&&E<=90)return E-65;if(97<=E&&E<=122)return E-97+26;if(48<=E&&E<=57)return E-48+52;if(E==43)return 62;if(E==47)return 63;throw"c:"+E};return g},b=function(D,A){var y=D,P=A,O=new Array(D*A),g={};g.setPixel=function(F,B,G){O[B*y+F]=G},g.write=function(F){F.writeString("GIF87a"),F.writeShort(y),F.writeShort(P),F.writeByte(128),F.writeByte(0),F.writeByte(0),F.writeByte(0),F.writeByte(0),F.writeByte(0),F.writeByte(255),F.writeByte(255),F.writeByte(255),F.writeString(","),F.writeShort(0),F.writeShort(0),F.writeShort(y),F.writeShort(P),F.writeByte(0);var B=2,G=E(B);F.writeByte(B);for(var K=0;G.length-K>255;)F.writeByte(255),F.writeBytes(G,K,255),K+=255;F.writeByte(G.length-K),F.writeBytes(G,K,G.length-K),F.writeByte(0),F.writeString(";")};var m=function(F){var B=F,G=0,K=0,Q={};return Q.write=function(dt,ct){if(dt>>>ct)throw"length over";for(;G+ct>=8;)B.writeByte(255&(dt<<G|K)),ct-=8-G,dt>>>=8-G,K=0,G=0;K=dt<<G|K,G=G+ct},Q.flush=function(){G>0&&B.writeByte(K)},Q},E=function(F){for(var B=1<<F,G=(1<<F)+1,K=F+1,Q=N(),dt=0;dt<B;dt+=1)Q.add(String.fromCharCode(dt));Q.add(String.fromCharCode(B)),Q.add(String.fromCharCode(G));var ct=p(),gt=m(ct);gt.write(B,K);var xt=0,Vt=String.fromCharCode(O[xt]);for(xt+=1;xt<O.length;){var rt=String.fromCharCode(O[xt]);xt+=1,Q.contains(Vt+rt)?Vt=Vt+rt:(gt.write(Q.indexOf(Vt),K),Q.size()<4095&&(Q.size()==1<<K&&(K+=1),Q.add(Vt+rt)),Vt=rt)}return gt.write(Q.indexOf(Vt),K),gt.write(G,K),gt.flush(),ct.toByteArray()},N=function(){var F={},B=0,G={};return G.add=function(K){if(G.contains(K))throw"dup key:"+K;F[K]=B,B+=1},G.size=function(){return B},G.indexOf=function(K){return F[K]},G.contains=function(K){return typeof F[K]<"u"},G};return g},R=function(D,A,y){for(var P=b(D,A),O=0;O<A;O+=1)for(var g=0;g<D;g+=1)P.setPixel(g,O,y(g,O));var m=p();P.write(m);for(var E=d(),N=m.toByteArray(),F=0;F<N.length;F+=1)E.writeByte(N[F]);return E.flush(),"data:image/gif;base64,"+E};return n}();(function(){e.stringToBytesFuncs["UTF-8"]=function(n){function s(r){for(var o=[],a=0;a<r.length;a++){var l=r.charCodeAt(a);l<128?o.push(l):l<2048?o.push(192|l>>6,128|l&63):l<55296||l>=57344?o.push(224|l>>12,128|l>>6&63,128|l&63):(a++,l=65536+((l&1023)<<10|r.charCodeAt(a)&1023),o.push(240|l>>18,128|l>>12&63,128|l>>6&63,128|l&63))}return o}return s(n)}})(),function(n){i.exports=n()}(function(){return e})})(Pd);var dg=Pd.exports;const pg=fg(dg),pl=4;function mg(i,t){const e=pg(0,"M");e.addData(i,"Byte"),e.make();const n=e.getModuleCount();let s="";for(let o=0;o<n;o+=1)for(let a=0;a<n;a+=1)e.isDark(o,a)&&(s+=`M${a+pl} ${o+pl}h1v1h-1z`);const r=n+2*pl;return Si("svg",{class:"qr",viewBox:`0 0 ${r} ${r}`,role:"img","aria-label":t},Si("rect",{width:r,height:r,fill:"#ffffff"}),Si("path",{d:s,fill:"#000000"}))}class gg{constructor(t){this.page=t,this.scenes=z("datalist",{id:"scenes"}),this.name=z("input",{type:"text",maxlength:32,pattern:"[A-Za-z0-9_\\-]{1,32}",required:!0}),this.people=z("div",{class:"people"}),this.create=z("button",{type:"submit",class:"primary"},H("desk.create")),this.tickets=z("div",{class:"tickets"}),this.rows=[],this.known=null,this.revision=-1,this.scene=z("input",{type:"text",maxlength:32,list:"scenes",pattern:"[A-Za-z0-9_\\-]{1,32}",required:!0}),this.end=Fe(H("desk.end"),()=>this.endSession(),{class:"danger"});const e=z("form",{onsubmit:n=>{n.preventDefault(),this.send()}},z("div",{class:"row"},qe(H("desk.scene"),this.scene),this.scenes,qe(H("desk.name"),this.name)),z("h3",{},H("desk.people")),this.people,z("div",{class:"row"},Fe(H("desk.add"),()=>this.add("TRAINEE","")),this.create));this.node=z("div",{class:"view desk-view"},Vn(H("desk.title"),"desk-panel",e,z("p",{class:"note"},H("desk.begins")),z("div",{class:"row"},this.end)),this.tickets),this.add("INSTRUCTOR","trainer"),this.add("TRAINEE","trainee")}update(){const{model:t}=this.page,e=t.may("create");Te(this.create,!e),Te(this.end,!e||!this.session()),t.revision!==this.revision&&(this.revision=t.revision,this.scenes.replaceChildren(...(t.hello?.scenes??[]).map(n=>z("option",{value:n})))),t.tickets!==this.known&&(this.known=t.tickets,this.showTickets())}session(){return this.page.model.tickets?.session??this.page.model.scene?.session}endSession(){const t=this.session();t&&this.page.order(H("desk.end"),{order:"end",session:t})}add(t,e){const n=this.rows.length+1,s=z("input",{type:"text",maxlength:32,pattern:"[A-Za-z0-9_\\-]{1,32}",required:!0}),r=z("input",{type:"text",maxlength:32,pattern:"[A-Za-z0-9_\\-]{0,32}"});r.value=e;const o=ti(ag.map(u=>[u,ls("role",u)]),t,()=>{}),a=Fe("✕",()=>this.drop(c),{"aria-label":H("desk.drop",{n}),class:"quiet"}),l=z("div",{class:"row person"},qe(H("desk.person",{n}),s),qe(H("desk.role",{n}),o),qe(H("desk.seat",{n}),r),a),c={node:l,name:s,role:o,seat:r};this.rows.push(c),this.people.append(l)}drop(t){this.rows=this.rows.filter(e=>e!==t),t.node.remove()}send(){const t={scene:this.scene.value.trim(),name:this.name.value.trim(),people:this.rows.map(n=>({name:n.name.value.trim(),role:n.role.value,seat:n.seat.value.trim()}))},e=lg(t)[0];if(e){const n=e.index===null?void 0:this.rows[e.index],s=e.field==="scene"?this.scene:e.field==="seat"?n?.seat:n?.name??this.name;s?.focus();const r=s?.closest("label")?.textContent??H("desk.people");this.page.report("error",`${r}: A-Z a-z 0-9 _ -, 1…32`);return}this.page.order(H("desk.create"),{order:"create",...t})}showTickets(){const t=this.known;if(!t)return this.tickets.replaceChildren();const e=t.tickets.map(n=>{const s=cg(location.origin,n),r=[H("desk.step1"),H("desk.step2"),H("desk.step3",{seat:n.seat||"SEAT"})];return z("article",{class:"ticket","aria-label":H("desk.ticket_of",{person:n.person})},z("h3",{},n.person," ",z("small",{},[ls("role",n.role),n.seat].filter(Boolean).join(", "))),mg(s,H("desk.qr",{person:n.person})),z("p",{},z("a",{href:s},H("desk.link"))),z("h4",{},H("desk.steps")),z("ol",{},...r.map(o=>z("li",{},o))),z("p",{class:"note"},H("desk.ticket_of",{person:n.person}),": ",z("code",{},n.ticket)))});this.tickets.replaceChildren(Vn(H("desk.tickets",{name:t.name}),"tickets-panel",z("p",{class:"note"},H("desk.single_use")),z("div",{class:"row no-print"},Fe(H("desk.print"),()=>window.print())),z("div",{class:"ticket-grid"},...e)))}}const wi="–";function en(i,t,e=""){if(i==null||!Number.isFinite(i))return wi;const n=i.toFixed(t),s=Number(n)===0?0 .toFixed(t):n;return e?`${s} ${e}`:s}function gr(i){return en(i==null?null:i*100,0,"%")}function ns(i){if(i==null||!Number.isFinite(i))return wi;const t=Math.max(0,Math.floor(i*10+1e-6)),e=Math.floor(t/10),n=a=>String(a).padStart(2,"0"),[s,r,o]=[Math.floor(e/3600),Math.floor(e/60)%60,e%60];return s>0?`${s}:${n(r)}:${n(o)}`:`${r}:${n(o)}.${t%10}`}const xu=40;function _g(i){return H(`alarm.${i.kind}`,{seat:i.seat||"–",detail:i.detail}).trim()}function Mu(i,t,e,n){return z("li",{class:i},z("time",{},t),z("span",{},e),z("small",{},n))}class Ld{constructor(t){this.page=t,this.alarms=z("ol",{class:"log"}),this.events=z("ol",{class:"log"}),this.rendered="";const e=(n,s)=>z("div",{class:"scroll log-box",tabindex:0,role:"group","aria-label":n},s);this.node=z("div",{class:"logs"},Vn(H("alarms.title"),"alarms-panel",e(H("alarms.title"),this.alarms)),Vn(H("events.title"),"events-panel",e(H("events.title"),this.events)))}update(){const{model:t}=this.page,e=t.alarms.list().slice(0,xu),n=t.events.toArray().slice(-xu).reverse(),s=JSON.stringify([e.map(r=>[r.number,r.until,r.detail]),n.map(r=>r.number)]);s!==this.rendered&&(this.rendered=s,this.alarms.replaceChildren(...e.length>0?e.map(r=>Mu(`${r.level}${r.until===null?" lasting":""}`,ns(r.t),_g(r),r.until===null?H("alarms.lasting"):H("alarms.until",{t:ns(r.until)}))):[z("li",{class:"empty"},H("alarms.none"))]),this.events.replaceChildren(...n.length>0?n.map(r=>Mu("event",ns(r.t),r.text,"")):[z("li",{class:"empty"},H("events.none"))]))}}const vg=50;function Dd(i){return i?.seats.filter(t=>t.kind==="MASTER")??[]}const Ra=i=>i>=0?Math.min(1,i):0;function yu(i){const t=i.map(Ra),e=t.reduce((o,a)=>o+a,0);if(t.length===0)return[];const n=e>0?t.map(o=>o/e):t.map(()=>1/t.length),s=1-n.reduce((o,a)=>o+a,0),r=n.indexOf(Math.max(...n));return n.map((o,a)=>a===r?Ra(o+s):o)}function Su(i,t,e){if(t<0||t>=i.length)return yu(i);if(i.length===1)return[1];const n=Ra(e),s=i.map((a,l)=>l===t?0:Ra(a)),r=s.reduce((a,l)=>a+l,0),o=s.map((a,l)=>l===t?n:r>0?a/r*(1-n):(1-n)/(i.length-1));return yu(o)}function Id(i,t){return Array.from({length:i},(e,n)=>n===t?1:0)}function ph(i){return Math.max(0,i.findIndex(t=>t.role==="INSTRUCTOR"))}function Ca(i){const t=i.map((n,s)=>s),e=t.filter(n=>i[n]?.role==="TRAINEE");return e.length>0?e:t.filter(n=>n!==ph(i))}function xg(i){const t=ph(i),e=Ca(i).filter(n=>n!==t);return e.length===0?Id(i.length,t):i.map((n,s)=>s===t?.5:e.includes(s)?.5/e.length:0)}function Mg(i,t){return i===null||t===null||i.length!==t.length?!1:i.every((e,n)=>Math.abs(e-(t[n]??0))<.005)}const Ud=[{name:"OSATS",range:[1,5],items:[{id:"respect_for_tissue"},{id:"time_and_motion"},{id:"instrument_handling"},{id:"knowledge_of_instruments"},{id:"use_of_assistants"},{id:"flow_and_forward_planning"},{id:"knowledge_of_procedure"}]},{name:"GEARS",range:[1,5],items:[{id:"depth_perception"},{id:"bimanual_dexterity"},{id:"efficiency"},{id:"force_sensitivity"},{id:"robotic_control"},{id:"autonomy",optional:!0}]},{name:"GOALS",range:[1,5],items:[{id:"depth_perception"},{id:"bimanual_dexterity"},{id:"efficiency"},{id:"tissue_handling"},{id:"autonomy"}]},{name:"CHECKLIST",range:[0,1],items:[{id:"device_checked"},{id:"task_explained"},{id:"contact_gentle"},{id:"target_reached"},{id:"no_force_limit"},{id:"hand_over_clear"}]}];function Qr(i){const t=Ud.find(e=>e.name===i);if(!t)throw new RangeError(`sheet ${i}: allowed are OSATS, GEARS, GOALS and CHECKLIST`);return t}function fc(i,t){const e={};for(const{id:n}of i.items){const s=Object.prototype.hasOwnProperty.call(t,n)?t[n]:void 0;s!==void 0&&Number.isInteger(s)&&s>=i.range[0]&&s<=i.range[1]&&(e[n]=s)}return e}function Eu(i,t){const e=fc(i,t);return{points:Object.values(e).reduce((s,r)=>s+r,0),of:i.items.filter(s=>!s.optional||e[s.id]!==void 0).length*i.range[1],missing:i.items.filter(s=>!s.optional&&e[s.id]===void 0).map(s=>s.id)}}function Nd(i,t,e,n){return i?.sheets.find(s=>s.person===t&&s.sheet===e&&s.of===n)??null}function yg(i,t,e,n){return Nd(i,t,e,n)?.closed?i?.sheets.filter(s=>s.person!==t&&s.sheet===e&&s.of===n&&s.closed)??[]:[]}const ml=i=>H(`item.${i}`);class Sg{constructor(t){this.page=t,this.of=ti([],"",()=>this.open()),this.items=z("div",{class:"items"}),this.total=z("p",{class:"total",role:"status"}),this.note=z("p",{class:"note"}),this.others=z("div",{class:"others"}),this.name="OSATS",this.scores={},this.closed=!1,this.drafts=new Map,this.knownScene=null,this.knownNotes=null;const e=ti(Ud.map(n=>[n.name,H(`sheet.${n.name}`)]),this.name,n=>{this.name=n,this.open()});this.save=Fe(H("sheet.save"),()=>this.send(!1)),this.close=Fe(H("sheet.close"),()=>this.send(!0),{class:"primary"}),this.node=Vn(H("sheet.title"),"sheet-panel",z("div",{class:"row"},qe(H("sheet.kind"),e),qe(H("sheet.of"),this.of)),this.items,z("div",{class:"row"},this.total,this.save,this.close),this.note,z("h3",{},H("sheet.others")),this.others)}update(){const{model:t}=this.page;if(t.scene&&t.scene!==this.knownScene){this.knownScene=t.scene;const a=Dd(t.scene),l=a[Ca(a)[0]??0]?.name??"";Us(this.of,a.map(c=>[c.name,c.name]),this.of.value||l),this.of.value||(this.of.value=l),this.open()}t.notes!==this.knownNotes&&(this.knownNotes=t.notes,this.open());const e=Qr(this.name),n=Eu(e,this.scores),s=n.missing.length,r=e.name==="CHECKLIST"||s===0?"":` · ${H("sheet.missing",{n:s})}`;Se(this.total,H("sheet.total",{points:n.points,of:n.of})+r);const o=t.may("score")&&!this.closed;Te(this.save,!o),Te(this.close,!o||e.name!=="CHECKLIST"&&s>0);for(const a of this.items.querySelectorAll("input"))Te(a,!o);Se(this.note,this.closed?H("sheet.closed"):s>0?H("sheet.closed_as_draft"):"")}key(){return`${this.name} ${this.of.value}`}open(){const{model:t}=this.page,e=Qr(this.name),n=t.hello?.person??"",s=Nd(t.notes,n,this.name,this.of.value),r=this.key();this.closed=s?.closed??!1,this.scores={...fc(e,s?.scores??{}),...this.closed?{}:this.drafts.get(r)};const o=document.activeElement?.id;this.items.replaceChildren(z("p",{class:"note"},H(e.name==="CHECKLIST"?"sheet.done":"sheet.low")),...e.items.map(a=>e.name==="CHECKLIST"?this.tick(a.id):this.points(a.id,a.optional===!0))),o?.startsWith("item-")&&document.getElementById(o)?.focus(),this.showOthers(n)}showOthers(t){const e=Qr(this.name),n=yg(this.page.model.notes,t,this.name,this.of.value);this.others.replaceChildren(...n.length>0?n.map(s=>{const{points:r,of:o}=Eu(e,s.scores),a=e.items.map(({id:l})=>`${ml(l)} ${s.scores[l]??"–"}`).join(" · ");return z("details",{},z("summary",{},`${s.person}: ${H("sheet.total",{points:r,of:o})}`),z("p",{},a))}):[z("p",{class:"note"},H(this.closed?"sheet.no_others":"sheet.hidden"))])}set(t,e){this.scores[t]=e,this.drafts.set(this.key(),this.scores),this.update()}points(t,e){const n=Qr(this.name),s=[];for(let o=n.range[0];o<=n.range[1];o+=1){const a=z("input",{type:"radio",name:`item-${this.name}-${t}`,id:`item-${this.name}-${t}-${o}`,onchange:()=>this.set(t,o)});a.checked=this.scores[t]===o,s.push(z("label",{class:"point"},a,z("span",{},String(o))))}const r=ml(t)+(e?` (${H("sheet.optional")})`:"");return z("fieldset",{class:"item"},z("legend",{},r),z("div",{class:"points"},...s))}tick(t){const e=z("input",{type:"checkbox",id:`item-${this.name}-${t}`,onchange:()=>this.set(t,e.checked?1:0)});return e.checked=this.scores[t]===1,z("label",{class:"check item"},e,z("span",{},ml(t)))}send(t){const e=fc(Qr(this.name),this.scores),n=this.key(),[s,r]=[this.name,this.of.value];this.page.request(H(t?"sheet.close":"sheet.save"),{type:"sheet",sheet:s,of:r,scores:e,closed:t}).then(o=>{o.ok&&this.drafts.delete(n)})}}const gl=1e3,Eg=100;class wg{constructor(t){this.page=t,this.note=z("input",{type:"text",maxlength:300,placeholder:H("marks.placeholder")}),this.ticks=Si("g"),this.list=z("ol",{class:"log"}),this.known=null,this.end=0,this.begun=null,this.add=Fe(H("marks.add"),()=>this.mark(),{class:"primary","aria-keyshortcuts":"M"}),this.line=Si("svg",{class:"timeline",viewBox:`0 0 ${gl} 40`,preserveAspectRatio:"none",role:"img"},Si("rect",{x:0,y:19,width:gl,height:2,class:"line"}),this.ticks),this.note.addEventListener("input",()=>{this.note.value===""?this.begun=null:this.begun??=this.page.model.state?.t??null});const e=z("form",{class:"row",onsubmit:n=>{n.preventDefault(),this.mark()}},qe(H("marks.note"),this.note),this.add);this.node=Vn(H("marks.title"),"timeline-panel",this.line,e,z("div",{class:"scroll log-box",tabindex:0,role:"group","aria-label":H("marks.title")},this.list))}mark(){const t=this.begun??this.page.model.state?.t;if(t===void 0||!this.page.model.may("score"))return;const e=this.note.value.trim();this.page.request(H("marks.add"),{type:"mark",t:Math.round(t*1e3)/1e3,text:e}).then(n=>{!n.ok||this.note.value.trim()!==e||(this.note.value="",this.begun=null)})}update(){const{model:t}=this.page;Te(this.add,!t.may("score")),Te(this.note,!t.may("score")),Se(this.add,this.begun===null?H("marks.add"):H("marks.at",{t:ns(this.begun)}));const e=t.state?.t??0,n=60*2**Math.max(0,Math.ceil(Math.log2(Math.max(1,e/60))));if(rs(this.line,"aria-label",H("marks.timeline",{t:ns(e)})),t.notes===this.known&&n===this.end)return;this.known=t.notes,this.end=n;const s=t.notes?.marks??[];this.ticks.replaceChildren(...s.map(o=>{const a=Math.min(1,Math.max(0,(o.t??0)/n))*(gl-6);return Si("rect",{x:a,y:6,width:6,height:28,rx:2},Si("title",{},`${ns(o.t)} ${o.text}`))}));const r=[...s].sort((o,a)=>(a.t??0)-(o.t??0)).slice(0,Eg);this.list.replaceChildren(...r.length>0?r.map(o=>z("li",{},z("time",{},ns(o.t)),z("span",{},o.text||"–"),z("small",{},o.person))):[z("li",{class:"empty"},H("marks.none"))])}}class bg{constructor(t){this.page=t,this.slot=z("div",{class:"slot"}),this.timeline=new wg(t);const e=new Sg(t),n=new Ld(t);this.parts=[this.timeline,e,n],this.node=z("div",{class:"view evaluator-view"},z("div",{class:"column"},this.slot,this.timeline.node,n.node),z("div",{class:"column"},e.node))}shown(){this.slot.append(this.page.pictureHost)}update(){for(const t of this.parts)t.update()}}/**
 * @license
 * Copyright 2010-2024 Three.js Authors
 * SPDX-License-Identifier: MIT
 */const mh="169",Sr={ROTATE:0,DOLLY:1,PAN:2},vr={ROTATE:0,PAN:1,DOLLY_PAN:2,DOLLY_ROTATE:3},Tg=0,wu=1,Ag=2,kd=1,Rg=2,Ni=3,cs=0,Nn=1,ki=2,os=0,Er=1,bu=2,Tu=3,Au=4,Cg=5,Ts=100,Pg=101,Lg=102,Dg=103,Ig=104,Ug=200,Ng=201,kg=202,Og=203,dc=204,pc=205,Fg=206,Bg=207,zg=208,Hg=209,Gg=210,Vg=211,Wg=212,Xg=213,qg=214,mc=0,gc=1,_c=2,Ar=3,vc=4,xc=5,Mc=6,yc=7,gh=0,Yg=1,jg=2,as=0,Kg=1,$g=2,Zg=3,Jg=4,Qg=5,t_=6,e_=7,Od=300,Rr=301,Cr=302,Sc=303,Ec=304,Ha=306,wc=1e3,Cs=1001,bc=1002,Qn=1003,n_=1004,Fo=1005,hi=1006,_l=1007,Ps=1008,Hi=1009,Fd=1010,Bd=1011,Mo=1012,_h=1013,Ns=1014,Oi=1015,wo=1016,vh=1017,xh=1018,Pr=1020,zd=35902,Hd=1021,Gd=1022,ui=1023,Vd=1024,Wd=1025,wr=1026,Lr=1027,Xd=1028,Mh=1029,qd=1030,yh=1031,Sh=1033,xa=33776,Ma=33777,ya=33778,Sa=33779,Tc=35840,Ac=35841,Rc=35842,Cc=35843,Pc=36196,Lc=37492,Dc=37496,Ic=37808,Uc=37809,Nc=37810,kc=37811,Oc=37812,Fc=37813,Bc=37814,zc=37815,Hc=37816,Gc=37817,Vc=37818,Wc=37819,Xc=37820,qc=37821,Ea=36492,Yc=36494,jc=36495,Yd=36283,Kc=36284,$c=36285,Zc=36286,i_=3200,s_=3201,jd=0,r_=1,es="",Mi="srgb",fs="srgb-linear",Eh="display-p3",Ga="display-p3-linear",Pa="linear",Oe="srgb",La="rec709",Da="p3",tr=7680,Ru=519,o_=512,a_=513,l_=514,Kd=515,c_=516,h_=517,u_=518,f_=519,Cu=35044,Pu="300 es",Fi=2e3,Ia=2001;class Bs{addEventListener(t,e){this._listeners===void 0&&(this._listeners={});const n=this._listeners;n[t]===void 0&&(n[t]=[]),n[t].indexOf(e)===-1&&n[t].push(e)}hasEventListener(t,e){if(this._listeners===void 0)return!1;const n=this._listeners;return n[t]!==void 0&&n[t].indexOf(e)!==-1}removeEventListener(t,e){if(this._listeners===void 0)return;const s=this._listeners[t];if(s!==void 0){const r=s.indexOf(e);r!==-1&&s.splice(r,1)}}dispatchEvent(t){if(this._listeners===void 0)return;const n=this._listeners[t.type];if(n!==void 0){t.target=this;const s=n.slice(0);for(let r=0,o=s.length;r<o;r++)s[r].call(this,t);t.target=null}}}const vn=["00","01","02","03","04","05","06","07","08","09","0a","0b","0c","0d","0e","0f","10","11","12","13","14","15","16","17","18","19","1a","1b","1c","1d","1e","1f","20","21","22","23","24","25","26","27","28","29","2a","2b","2c","2d","2e","2f","30","31","32","33","34","35","36","37","38","39","3a","3b","3c","3d","3e","3f","40","41","42","43","44","45","46","47","48","49","4a","4b","4c","4d","4e","4f","50","51","52","53","54","55","56","57","58","59","5a","5b","5c","5d","5e","5f","60","61","62","63","64","65","66","67","68","69","6a","6b","6c","6d","6e","6f","70","71","72","73","74","75","76","77","78","79","7a","7b","7c","7d","7e","7f","80","81","82","83","84","85","86","87","88","89","8a","8b","8c","8d","8e","8f","90","91","92","93","94","95","96","97","98","99","9a","9b","9c","9d","9e","9f","a0","a1","a2","a3","a4","a5","a6","a7","a8","a9","aa","ab","ac","ad","ae","af","b0","b1","b2","b3","b4","b5","b6","b7","b8","b9","ba","bb","bc","bd","be","bf","c0","c1","c2","c3","c4","c5","c6","c7","c8","c9","ca","cb","cc","cd","ce","cf","d0","d1","d2","d3","d4","d5","d6","d7","d8","d9","da","db","dc","dd","de","df","e0","e1","e2","e3","e4","e5","e6","e7","e8","e9","ea","eb","ec","ed","ee","ef","f0","f1","f2","f3","f4","f5","f6","f7","f8","f9","fa","fb","fc","fd","fe","ff"],mo=Math.PI/180,Jc=180/Math.PI;function bo(){const i=Math.random()*4294967295|0,t=Math.random()*4294967295|0,e=Math.random()*4294967295|0,n=Math.random()*4294967295|0;return(vn[i&255]+vn[i>>8&255]+vn[i>>16&255]+vn[i>>24&255]+"-"+vn[t&255]+vn[t>>8&255]+"-"+vn[t>>16&15|64]+vn[t>>24&255]+"-"+vn[e&63|128]+vn[e>>8&255]+"-"+vn[e>>16&255]+vn[e>>24&255]+vn[n&255]+vn[n>>8&255]+vn[n>>16&255]+vn[n>>24&255]).toLowerCase()}function Rn(i,t,e){return Math.max(t,Math.min(e,i))}function d_(i,t){return(i%t+t)%t}function vl(i,t,e){return(1-e)*i+e*t}function to(i,t){switch(t.constructor){case Float32Array:return i;case Uint32Array:return i/4294967295;case Uint16Array:return i/65535;case Uint8Array:return i/255;case Int32Array:return Math.max(i/2147483647,-1);case Int16Array:return Math.max(i/32767,-1);case Int8Array:return Math.max(i/127,-1);default:throw new Error("Invalid component type.")}}function In(i,t){switch(t.constructor){case Float32Array:return i;case Uint32Array:return Math.round(i*4294967295);case Uint16Array:return Math.round(i*65535);case Uint8Array:return Math.round(i*255);case Int32Array:return Math.round(i*2147483647);case Int16Array:return Math.round(i*32767);case Int8Array:return Math.round(i*127);default:throw new Error("Invalid component type.")}}const p_={DEG2RAD:mo};class se{constructor(t=0,e=0){se.prototype.isVector2=!0,this.x=t,this.y=e}get width(){return this.x}set width(t){this.x=t}get height(){return this.y}set height(t){this.y=t}set(t,e){return this.x=t,this.y=e,this}setScalar(t){return this.x=t,this.y=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;default:throw new Error("index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;default:throw new Error("index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y)}copy(t){return this.x=t.x,this.y=t.y,this}add(t){return this.x+=t.x,this.y+=t.y,this}addScalar(t){return this.x+=t,this.y+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this}subScalar(t){return this.x-=t,this.y-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this}multiply(t){return this.x*=t.x,this.y*=t.y,this}multiplyScalar(t){return this.x*=t,this.y*=t,this}divide(t){return this.x/=t.x,this.y/=t.y,this}divideScalar(t){return this.multiplyScalar(1/t)}applyMatrix3(t){const e=this.x,n=this.y,s=t.elements;return this.x=s[0]*e+s[3]*n+s[6],this.y=s[1]*e+s[4]*n+s[7],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this}clamp(t,e){return this.x=Math.max(t.x,Math.min(e.x,this.x)),this.y=Math.max(t.y,Math.min(e.y,this.y)),this}clampScalar(t,e){return this.x=Math.max(t,Math.min(e,this.x)),this.y=Math.max(t,Math.min(e,this.y)),this}clampLength(t,e){const n=this.length();return this.divideScalar(n||1).multiplyScalar(Math.max(t,Math.min(e,n)))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this}negate(){return this.x=-this.x,this.y=-this.y,this}dot(t){return this.x*t.x+this.y*t.y}cross(t){return this.x*t.y-this.y*t.x}lengthSq(){return this.x*this.x+this.y*this.y}length(){return Math.sqrt(this.x*this.x+this.y*this.y)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)}normalize(){return this.divideScalar(this.length()||1)}angle(){return Math.atan2(-this.y,-this.x)+Math.PI}angleTo(t){const e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;const n=this.dot(t)/e;return Math.acos(Rn(n,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){const e=this.x-t.x,n=this.y-t.y;return e*e+n*n}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this}lerpVectors(t,e,n){return this.x=t.x+(e.x-t.x)*n,this.y=t.y+(e.y-t.y)*n,this}equals(t){return t.x===this.x&&t.y===this.y}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this}rotateAround(t,e){const n=Math.cos(e),s=Math.sin(e),r=this.x-t.x,o=this.y-t.y;return this.x=r*n-o*s+t.x,this.y=r*s+o*n+t.y,this}random(){return this.x=Math.random(),this.y=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y}}class ae{constructor(t,e,n,s,r,o,a,l,c){ae.prototype.isMatrix3=!0,this.elements=[1,0,0,0,1,0,0,0,1],t!==void 0&&this.set(t,e,n,s,r,o,a,l,c)}set(t,e,n,s,r,o,a,l,c){const u=this.elements;return u[0]=t,u[1]=s,u[2]=a,u[3]=e,u[4]=r,u[5]=l,u[6]=n,u[7]=o,u[8]=c,this}identity(){return this.set(1,0,0,0,1,0,0,0,1),this}copy(t){const e=this.elements,n=t.elements;return e[0]=n[0],e[1]=n[1],e[2]=n[2],e[3]=n[3],e[4]=n[4],e[5]=n[5],e[6]=n[6],e[7]=n[7],e[8]=n[8],this}extractBasis(t,e,n){return t.setFromMatrix3Column(this,0),e.setFromMatrix3Column(this,1),n.setFromMatrix3Column(this,2),this}setFromMatrix4(t){const e=t.elements;return this.set(e[0],e[4],e[8],e[1],e[5],e[9],e[2],e[6],e[10]),this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){const n=t.elements,s=e.elements,r=this.elements,o=n[0],a=n[3],l=n[6],c=n[1],u=n[4],f=n[7],h=n[2],_=n[5],x=n[8],M=s[0],p=s[3],d=s[6],C=s[1],b=s[4],R=s[7],D=s[2],A=s[5],y=s[8];return r[0]=o*M+a*C+l*D,r[3]=o*p+a*b+l*A,r[6]=o*d+a*R+l*y,r[1]=c*M+u*C+f*D,r[4]=c*p+u*b+f*A,r[7]=c*d+u*R+f*y,r[2]=h*M+_*C+x*D,r[5]=h*p+_*b+x*A,r[8]=h*d+_*R+x*y,this}multiplyScalar(t){const e=this.elements;return e[0]*=t,e[3]*=t,e[6]*=t,e[1]*=t,e[4]*=t,e[7]*=t,e[2]*=t,e[5]*=t,e[8]*=t,this}determinant(){const t=this.elements,e=t[0],n=t[1],s=t[2],r=t[3],o=t[4],a=t[5],l=t[6],c=t[7],u=t[8];return e*o*u-e*a*c-n*r*u+n*a*l+s*r*c-s*o*l}invert(){const t=this.elements,e=t[0],n=t[1],s=t[2],r=t[3],o=t[4],a=t[5],l=t[6],c=t[7],u=t[8],f=u*o-a*c,h=a*l-u*r,_=c*r-o*l,x=e*f+n*h+s*_;if(x===0)return this.set(0,0,0,0,0,0,0,0,0);const M=1/x;return t[0]=f*M,t[1]=(s*c-u*n)*M,t[2]=(a*n-s*o)*M,t[3]=h*M,t[4]=(u*e-s*l)*M,t[5]=(s*r-a*e)*M,t[6]=_*M,t[7]=(n*l-c*e)*M,t[8]=(o*e-n*r)*M,this}transpose(){let t;const e=this.elements;return t=e[1],e[1]=e[3],e[3]=t,t=e[2],e[2]=e[6],e[6]=t,t=e[5],e[5]=e[7],e[7]=t,this}getNormalMatrix(t){return this.setFromMatrix4(t).invert().transpose()}transposeIntoArray(t){const e=this.elements;return t[0]=e[0],t[1]=e[3],t[2]=e[6],t[3]=e[1],t[4]=e[4],t[5]=e[7],t[6]=e[2],t[7]=e[5],t[8]=e[8],this}setUvTransform(t,e,n,s,r,o,a){const l=Math.cos(r),c=Math.sin(r);return this.set(n*l,n*c,-n*(l*o+c*a)+o+t,-s*c,s*l,-s*(-c*o+l*a)+a+e,0,0,1),this}scale(t,e){return this.premultiply(xl.makeScale(t,e)),this}rotate(t){return this.premultiply(xl.makeRotation(-t)),this}translate(t,e){return this.premultiply(xl.makeTranslation(t,e)),this}makeTranslation(t,e){return t.isVector2?this.set(1,0,t.x,0,1,t.y,0,0,1):this.set(1,0,t,0,1,e,0,0,1),this}makeRotation(t){const e=Math.cos(t),n=Math.sin(t);return this.set(e,-n,0,n,e,0,0,0,1),this}makeScale(t,e){return this.set(t,0,0,0,e,0,0,0,1),this}equals(t){const e=this.elements,n=t.elements;for(let s=0;s<9;s++)if(e[s]!==n[s])return!1;return!0}fromArray(t,e=0){for(let n=0;n<9;n++)this.elements[n]=t[n+e];return this}toArray(t=[],e=0){const n=this.elements;return t[e]=n[0],t[e+1]=n[1],t[e+2]=n[2],t[e+3]=n[3],t[e+4]=n[4],t[e+5]=n[5],t[e+6]=n[6],t[e+7]=n[7],t[e+8]=n[8],t}clone(){return new this.constructor().fromArray(this.elements)}}const xl=new ae;function $d(i){for(let t=i.length-1;t>=0;--t)if(i[t]>=65535)return!0;return!1}function Ua(i){return document.createElementNS("http://www.w3.org/1999/xhtml",i)}function m_(){const i=Ua("canvas");return i.style.display="block",i}const Lu={};function wa(i){i in Lu||(Lu[i]=!0,console.warn(i))}function g_(i,t,e){return new Promise(function(n,s){function r(){switch(i.clientWaitSync(t,i.SYNC_FLUSH_COMMANDS_BIT,0)){case i.WAIT_FAILED:s();break;case i.TIMEOUT_EXPIRED:setTimeout(r,e);break;default:n()}}setTimeout(r,e)})}function __(i){const t=i.elements;t[2]=.5*t[2]+.5*t[3],t[6]=.5*t[6]+.5*t[7],t[10]=.5*t[10]+.5*t[11],t[14]=.5*t[14]+.5*t[15]}function v_(i){const t=i.elements;t[11]===-1?(t[10]=-t[10]-1,t[14]=-t[14]):(t[10]=-t[10],t[14]=-t[14]+1)}const Du=new ae().set(.8224621,.177538,0,.0331941,.9668058,0,.0170827,.0723974,.9105199),Iu=new ae().set(1.2249401,-.2249404,0,-.0420569,1.0420571,0,-.0196376,-.0786361,1.0982735),eo={[fs]:{transfer:Pa,primaries:La,luminanceCoefficients:[.2126,.7152,.0722],toReference:i=>i,fromReference:i=>i},[Mi]:{transfer:Oe,primaries:La,luminanceCoefficients:[.2126,.7152,.0722],toReference:i=>i.convertSRGBToLinear(),fromReference:i=>i.convertLinearToSRGB()},[Ga]:{transfer:Pa,primaries:Da,luminanceCoefficients:[.2289,.6917,.0793],toReference:i=>i.applyMatrix3(Iu),fromReference:i=>i.applyMatrix3(Du)},[Eh]:{transfer:Oe,primaries:Da,luminanceCoefficients:[.2289,.6917,.0793],toReference:i=>i.convertSRGBToLinear().applyMatrix3(Iu),fromReference:i=>i.applyMatrix3(Du).convertLinearToSRGB()}},x_=new Set([fs,Ga]),ye={enabled:!0,_workingColorSpace:fs,get workingColorSpace(){return this._workingColorSpace},set workingColorSpace(i){if(!x_.has(i))throw new Error(`Unsupported working color space, "${i}".`);this._workingColorSpace=i},convert:function(i,t,e){if(this.enabled===!1||t===e||!t||!e)return i;const n=eo[t].toReference,s=eo[e].fromReference;return s(n(i))},fromWorkingColorSpace:function(i,t){return this.convert(i,this._workingColorSpace,t)},toWorkingColorSpace:function(i,t){return this.convert(i,t,this._workingColorSpace)},getPrimaries:function(i){return eo[i].primaries},getTransfer:function(i){return i===es?Pa:eo[i].transfer},getLuminanceCoefficients:function(i,t=this._workingColorSpace){return i.fromArray(eo[t].luminanceCoefficients)}};function br(i){return i<.04045?i*.0773993808:Math.pow(i*.9478672986+.0521327014,2.4)}function Ml(i){return i<.0031308?i*12.92:1.055*Math.pow(i,.41666)-.055}let er;class M_{static getDataURL(t){if(/^data:/i.test(t.src)||typeof HTMLCanvasElement>"u")return t.src;let e;if(t instanceof HTMLCanvasElement)e=t;else{er===void 0&&(er=Ua("canvas")),er.width=t.width,er.height=t.height;const n=er.getContext("2d");t instanceof ImageData?n.putImageData(t,0,0):n.drawImage(t,0,0,t.width,t.height),e=er}return e.width>2048||e.height>2048?(console.warn("THREE.ImageUtils.getDataURL: Image converted to jpg for performance reasons",t),e.toDataURL("image/jpeg",.6)):e.toDataURL("image/png")}static sRGBToLinear(t){if(typeof HTMLImageElement<"u"&&t instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&t instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&t instanceof ImageBitmap){const e=Ua("canvas");e.width=t.width,e.height=t.height;const n=e.getContext("2d");n.drawImage(t,0,0,t.width,t.height);const s=n.getImageData(0,0,t.width,t.height),r=s.data;for(let o=0;o<r.length;o++)r[o]=br(r[o]/255)*255;return n.putImageData(s,0,0),e}else if(t.data){const e=t.data.slice(0);for(let n=0;n<e.length;n++)e instanceof Uint8Array||e instanceof Uint8ClampedArray?e[n]=Math.floor(br(e[n]/255)*255):e[n]=br(e[n]);return{data:e,width:t.width,height:t.height}}else return console.warn("THREE.ImageUtils.sRGBToLinear(): Unsupported image type. No color space conversion applied."),t}}let y_=0;class Zd{constructor(t=null){this.isSource=!0,Object.defineProperty(this,"id",{value:y_++}),this.uuid=bo(),this.data=t,this.dataReady=!0,this.version=0}set needsUpdate(t){t===!0&&this.version++}toJSON(t){const e=t===void 0||typeof t=="string";if(!e&&t.images[this.uuid]!==void 0)return t.images[this.uuid];const n={uuid:this.uuid,url:""},s=this.data;if(s!==null){let r;if(Array.isArray(s)){r=[];for(let o=0,a=s.length;o<a;o++)s[o].isDataTexture?r.push(yl(s[o].image)):r.push(yl(s[o]))}else r=yl(s);n.url=r}return e||(t.images[this.uuid]=n),n}}function yl(i){return typeof HTMLImageElement<"u"&&i instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&i instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&i instanceof ImageBitmap?M_.getDataURL(i):i.data?{data:Array.from(i.data),width:i.width,height:i.height,type:i.data.constructor.name}:(console.warn("THREE.Texture: Unable to serialize Texture."),{})}let S_=0;class kn extends Bs{constructor(t=kn.DEFAULT_IMAGE,e=kn.DEFAULT_MAPPING,n=Cs,s=Cs,r=hi,o=Ps,a=ui,l=Hi,c=kn.DEFAULT_ANISOTROPY,u=es){super(),this.isTexture=!0,Object.defineProperty(this,"id",{value:S_++}),this.uuid=bo(),this.name="",this.source=new Zd(t),this.mipmaps=[],this.mapping=e,this.channel=0,this.wrapS=n,this.wrapT=s,this.magFilter=r,this.minFilter=o,this.anisotropy=c,this.format=a,this.internalFormat=null,this.type=l,this.offset=new se(0,0),this.repeat=new se(1,1),this.center=new se(0,0),this.rotation=0,this.matrixAutoUpdate=!0,this.matrix=new ae,this.generateMipmaps=!0,this.premultiplyAlpha=!1,this.flipY=!0,this.unpackAlignment=4,this.colorSpace=u,this.userData={},this.version=0,this.onUpdate=null,this.isRenderTargetTexture=!1,this.pmremVersion=0}get image(){return this.source.data}set image(t=null){this.source.data=t}updateMatrix(){this.matrix.setUvTransform(this.offset.x,this.offset.y,this.repeat.x,this.repeat.y,this.rotation,this.center.x,this.center.y)}clone(){return new this.constructor().copy(this)}copy(t){return this.name=t.name,this.source=t.source,this.mipmaps=t.mipmaps.slice(0),this.mapping=t.mapping,this.channel=t.channel,this.wrapS=t.wrapS,this.wrapT=t.wrapT,this.magFilter=t.magFilter,this.minFilter=t.minFilter,this.anisotropy=t.anisotropy,this.format=t.format,this.internalFormat=t.internalFormat,this.type=t.type,this.offset.copy(t.offset),this.repeat.copy(t.repeat),this.center.copy(t.center),this.rotation=t.rotation,this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrix.copy(t.matrix),this.generateMipmaps=t.generateMipmaps,this.premultiplyAlpha=t.premultiplyAlpha,this.flipY=t.flipY,this.unpackAlignment=t.unpackAlignment,this.colorSpace=t.colorSpace,this.userData=JSON.parse(JSON.stringify(t.userData)),this.needsUpdate=!0,this}toJSON(t){const e=t===void 0||typeof t=="string";if(!e&&t.textures[this.uuid]!==void 0)return t.textures[this.uuid];const n={metadata:{version:4.6,type:"Texture",generator:"Texture.toJSON"},uuid:this.uuid,name:this.name,image:this.source.toJSON(t).uuid,mapping:this.mapping,channel:this.channel,repeat:[this.repeat.x,this.repeat.y],offset:[this.offset.x,this.offset.y],center:[this.center.x,this.center.y],rotation:this.rotation,wrap:[this.wrapS,this.wrapT],format:this.format,internalFormat:this.internalFormat,type:this.type,colorSpace:this.colorSpace,minFilter:this.minFilter,magFilter:this.magFilter,anisotropy:this.anisotropy,flipY:this.flipY,generateMipmaps:this.generateMipmaps,premultiplyAlpha:this.premultiplyAlpha,unpackAlignment:this.unpackAlignment};return Object.keys(this.userData).length>0&&(n.userData=this.userData),e||(t.textures[this.uuid]=n),n}dispose(){this.dispatchEvent({type:"dispose"})}transformUv(t){if(this.mapping!==Od)return t;if(t.applyMatrix3(this.matrix),t.x<0||t.x>1)switch(this.wrapS){case wc:t.x=t.x-Math.floor(t.x);break;case Cs:t.x=t.x<0?0:1;break;case bc:Math.abs(Math.floor(t.x)%2)===1?t.x=Math.ceil(t.x)-t.x:t.x=t.x-Math.floor(t.x);break}if(t.y<0||t.y>1)switch(this.wrapT){case wc:t.y=t.y-Math.floor(t.y);break;case Cs:t.y=t.y<0?0:1;break;case bc:Math.abs(Math.floor(t.y)%2)===1?t.y=Math.ceil(t.y)-t.y:t.y=t.y-Math.floor(t.y);break}return this.flipY&&(t.y=1-t.y),t}set needsUpdate(t){t===!0&&(this.version++,this.source.needsUpdate=!0)}set needsPMREMUpdate(t){t===!0&&this.pmremVersion++}}kn.DEFAULT_IMAGE=null;kn.DEFAULT_MAPPING=Od;kn.DEFAULT_ANISOTROPY=1;class Ye{constructor(t=0,e=0,n=0,s=1){Ye.prototype.isVector4=!0,this.x=t,this.y=e,this.z=n,this.w=s}get width(){return this.z}set width(t){this.z=t}get height(){return this.w}set height(t){this.w=t}set(t,e,n,s){return this.x=t,this.y=e,this.z=n,this.w=s,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this.w=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setW(t){return this.w=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;case 3:this.w=e;break;default:throw new Error("index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;case 3:return this.w;default:throw new Error("index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z,this.w)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this.w=t.w!==void 0?t.w:1,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this.w+=t.w,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this.w+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this.w=t.w+e.w,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this.w+=t.w*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this.w-=t.w,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this.w-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this.w=t.w-e.w,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this.w*=t.w,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this.w*=t,this}applyMatrix4(t){const e=this.x,n=this.y,s=this.z,r=this.w,o=t.elements;return this.x=o[0]*e+o[4]*n+o[8]*s+o[12]*r,this.y=o[1]*e+o[5]*n+o[9]*s+o[13]*r,this.z=o[2]*e+o[6]*n+o[10]*s+o[14]*r,this.w=o[3]*e+o[7]*n+o[11]*s+o[15]*r,this}divideScalar(t){return this.multiplyScalar(1/t)}setAxisAngleFromQuaternion(t){this.w=2*Math.acos(t.w);const e=Math.sqrt(1-t.w*t.w);return e<1e-4?(this.x=1,this.y=0,this.z=0):(this.x=t.x/e,this.y=t.y/e,this.z=t.z/e),this}setAxisAngleFromRotationMatrix(t){let e,n,s,r;const l=t.elements,c=l[0],u=l[4],f=l[8],h=l[1],_=l[5],x=l[9],M=l[2],p=l[6],d=l[10];if(Math.abs(u-h)<.01&&Math.abs(f-M)<.01&&Math.abs(x-p)<.01){if(Math.abs(u+h)<.1&&Math.abs(f+M)<.1&&Math.abs(x+p)<.1&&Math.abs(c+_+d-3)<.1)return this.set(1,0,0,0),this;e=Math.PI;const b=(c+1)/2,R=(_+1)/2,D=(d+1)/2,A=(u+h)/4,y=(f+M)/4,P=(x+p)/4;return b>R&&b>D?b<.01?(n=0,s=.707106781,r=.707106781):(n=Math.sqrt(b),s=A/n,r=y/n):R>D?R<.01?(n=.707106781,s=0,r=.707106781):(s=Math.sqrt(R),n=A/s,r=P/s):D<.01?(n=.707106781,s=.707106781,r=0):(r=Math.sqrt(D),n=y/r,s=P/r),this.set(n,s,r,e),this}let C=Math.sqrt((p-x)*(p-x)+(f-M)*(f-M)+(h-u)*(h-u));return Math.abs(C)<.001&&(C=1),this.x=(p-x)/C,this.y=(f-M)/C,this.z=(h-u)/C,this.w=Math.acos((c+_+d-1)/2),this}setFromMatrixPosition(t){const e=t.elements;return this.x=e[12],this.y=e[13],this.z=e[14],this.w=e[15],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this.w=Math.min(this.w,t.w),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this.w=Math.max(this.w,t.w),this}clamp(t,e){return this.x=Math.max(t.x,Math.min(e.x,this.x)),this.y=Math.max(t.y,Math.min(e.y,this.y)),this.z=Math.max(t.z,Math.min(e.z,this.z)),this.w=Math.max(t.w,Math.min(e.w,this.w)),this}clampScalar(t,e){return this.x=Math.max(t,Math.min(e,this.x)),this.y=Math.max(t,Math.min(e,this.y)),this.z=Math.max(t,Math.min(e,this.z)),this.w=Math.max(t,Math.min(e,this.w)),this}clampLength(t,e){const n=this.length();return this.divideScalar(n||1).multiplyScalar(Math.max(t,Math.min(e,n)))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this.w=Math.floor(this.w),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this.w=Math.ceil(this.w),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this.w=Math.round(this.w),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this.w=Math.trunc(this.w),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this.w=-this.w,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z+this.w*t.w}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)+Math.abs(this.w)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this.w+=(t.w-this.w)*e,this}lerpVectors(t,e,n){return this.x=t.x+(e.x-t.x)*n,this.y=t.y+(e.y-t.y)*n,this.z=t.z+(e.z-t.z)*n,this.w=t.w+(e.w-t.w)*n,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z&&t.w===this.w}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this.w=t[e+3],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t[e+3]=this.w,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this.w=t.getW(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this.w=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z,yield this.w}}class E_ extends Bs{constructor(t=1,e=1,n={}){super(),this.isRenderTarget=!0,this.width=t,this.height=e,this.depth=1,this.scissor=new Ye(0,0,t,e),this.scissorTest=!1,this.viewport=new Ye(0,0,t,e);const s={width:t,height:e,depth:1};n=Object.assign({generateMipmaps:!1,internalFormat:null,minFilter:hi,depthBuffer:!0,stencilBuffer:!1,resolveDepthBuffer:!0,resolveStencilBuffer:!0,depthTexture:null,samples:0,count:1},n);const r=new kn(s,n.mapping,n.wrapS,n.wrapT,n.magFilter,n.minFilter,n.format,n.type,n.anisotropy,n.colorSpace);r.flipY=!1,r.generateMipmaps=n.generateMipmaps,r.internalFormat=n.internalFormat,this.textures=[];const o=n.count;for(let a=0;a<o;a++)this.textures[a]=r.clone(),this.textures[a].isRenderTargetTexture=!0;this.depthBuffer=n.depthBuffer,this.stencilBuffer=n.stencilBuffer,this.resolveDepthBuffer=n.resolveDepthBuffer,this.resolveStencilBuffer=n.resolveStencilBuffer,this.depthTexture=n.depthTexture,this.samples=n.samples}get texture(){return this.textures[0]}set texture(t){this.textures[0]=t}setSize(t,e,n=1){if(this.width!==t||this.height!==e||this.depth!==n){this.width=t,this.height=e,this.depth=n;for(let s=0,r=this.textures.length;s<r;s++)this.textures[s].image.width=t,this.textures[s].image.height=e,this.textures[s].image.depth=n;this.dispose()}this.viewport.set(0,0,t,e),this.scissor.set(0,0,t,e)}clone(){return new this.constructor().copy(this)}copy(t){this.width=t.width,this.height=t.height,this.depth=t.depth,this.scissor.copy(t.scissor),this.scissorTest=t.scissorTest,this.viewport.copy(t.viewport),this.textures.length=0;for(let n=0,s=t.textures.length;n<s;n++)this.textures[n]=t.textures[n].clone(),this.textures[n].isRenderTargetTexture=!0;const e=Object.assign({},t.texture.image);return this.texture.source=new Zd(e),this.depthBuffer=t.depthBuffer,this.stencilBuffer=t.stencilBuffer,this.resolveDepthBuffer=t.resolveDepthBuffer,this.resolveStencilBuffer=t.resolveStencilBuffer,t.depthTexture!==null&&(this.depthTexture=t.depthTexture.clone()),this.samples=t.samples,this}dispose(){this.dispatchEvent({type:"dispose"})}}class ks extends E_{constructor(t=1,e=1,n={}){super(t,e,n),this.isWebGLRenderTarget=!0}}class Jd extends kn{constructor(t=null,e=1,n=1,s=1){super(null),this.isDataArrayTexture=!0,this.image={data:t,width:e,height:n,depth:s},this.magFilter=Qn,this.minFilter=Qn,this.wrapR=Cs,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1,this.layerUpdates=new Set}addLayerUpdate(t){this.layerUpdates.add(t)}clearLayerUpdates(){this.layerUpdates.clear()}}class w_ extends kn{constructor(t=null,e=1,n=1,s=1){super(null),this.isData3DTexture=!0,this.image={data:t,width:e,height:n,depth:s},this.magFilter=Qn,this.minFilter=Qn,this.wrapR=Cs,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}}class Os{constructor(t=0,e=0,n=0,s=1){this.isQuaternion=!0,this._x=t,this._y=e,this._z=n,this._w=s}static slerpFlat(t,e,n,s,r,o,a){let l=n[s+0],c=n[s+1],u=n[s+2],f=n[s+3];const h=r[o+0],_=r[o+1],x=r[o+2],M=r[o+3];if(a===0){t[e+0]=l,t[e+1]=c,t[e+2]=u,t[e+3]=f;return}if(a===1){t[e+0]=h,t[e+1]=_,t[e+2]=x,t[e+3]=M;return}if(f!==M||l!==h||c!==_||u!==x){let p=1-a;const d=l*h+c*_+u*x+f*M,C=d>=0?1:-1,b=1-d*d;if(b>Number.EPSILON){const D=Math.sqrt(b),A=Math.atan2(D,d*C);p=Math.sin(p*A)/D,a=Math.sin(a*A)/D}const R=a*C;if(l=l*p+h*R,c=c*p+_*R,u=u*p+x*R,f=f*p+M*R,p===1-a){const D=1/Math.sqrt(l*l+c*c+u*u+f*f);l*=D,c*=D,u*=D,f*=D}}t[e]=l,t[e+1]=c,t[e+2]=u,t[e+3]=f}static multiplyQuaternionsFlat(t,e,n,s,r,o){const a=n[s],l=n[s+1],c=n[s+2],u=n[s+3],f=r[o],h=r[o+1],_=r[o+2],x=r[o+3];return t[e]=a*x+u*f+l*_-c*h,t[e+1]=l*x+u*h+c*f-a*_,t[e+2]=c*x+u*_+a*h-l*f,t[e+3]=u*x-a*f-l*h-c*_,t}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get w(){return this._w}set w(t){this._w=t,this._onChangeCallback()}set(t,e,n,s){return this._x=t,this._y=e,this._z=n,this._w=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._w)}copy(t){return this._x=t.x,this._y=t.y,this._z=t.z,this._w=t.w,this._onChangeCallback(),this}setFromEuler(t,e=!0){const n=t._x,s=t._y,r=t._z,o=t._order,a=Math.cos,l=Math.sin,c=a(n/2),u=a(s/2),f=a(r/2),h=l(n/2),_=l(s/2),x=l(r/2);switch(o){case"XYZ":this._x=h*u*f+c*_*x,this._y=c*_*f-h*u*x,this._z=c*u*x+h*_*f,this._w=c*u*f-h*_*x;break;case"YXZ":this._x=h*u*f+c*_*x,this._y=c*_*f-h*u*x,this._z=c*u*x-h*_*f,this._w=c*u*f+h*_*x;break;case"ZXY":this._x=h*u*f-c*_*x,this._y=c*_*f+h*u*x,this._z=c*u*x+h*_*f,this._w=c*u*f-h*_*x;break;case"ZYX":this._x=h*u*f-c*_*x,this._y=c*_*f+h*u*x,this._z=c*u*x-h*_*f,this._w=c*u*f+h*_*x;break;case"YZX":this._x=h*u*f+c*_*x,this._y=c*_*f+h*u*x,this._z=c*u*x-h*_*f,this._w=c*u*f-h*_*x;break;case"XZY":this._x=h*u*f-c*_*x,this._y=c*_*f-h*u*x,this._z=c*u*x+h*_*f,this._w=c*u*f+h*_*x;break;default:console.warn("THREE.Quaternion: .setFromEuler() encountered an unknown order: "+o)}return e===!0&&this._onChangeCallback(),this}setFromAxisAngle(t,e){const n=e/2,s=Math.sin(n);return this._x=t.x*s,this._y=t.y*s,this._z=t.z*s,this._w=Math.cos(n),this._onChangeCallback(),this}setFromRotationMatrix(t){const e=t.elements,n=e[0],s=e[4],r=e[8],o=e[1],a=e[5],l=e[9],c=e[2],u=e[6],f=e[10],h=n+a+f;if(h>0){const _=.5/Math.sqrt(h+1);this._w=.25/_,this._x=(u-l)*_,this._y=(r-c)*_,this._z=(o-s)*_}else if(n>a&&n>f){const _=2*Math.sqrt(1+n-a-f);this._w=(u-l)/_,this._x=.25*_,this._y=(s+o)/_,this._z=(r+c)/_}else if(a>f){const _=2*Math.sqrt(1+a-n-f);this._w=(r-c)/_,this._x=(s+o)/_,this._y=.25*_,this._z=(l+u)/_}else{const _=2*Math.sqrt(1+f-n-a);this._w=(o-s)/_,this._x=(r+c)/_,this._y=(l+u)/_,this._z=.25*_}return this._onChangeCallback(),this}setFromUnitVectors(t,e){let n=t.dot(e)+1;return n<Number.EPSILON?(n=0,Math.abs(t.x)>Math.abs(t.z)?(this._x=-t.y,this._y=t.x,this._z=0,this._w=n):(this._x=0,this._y=-t.z,this._z=t.y,this._w=n)):(this._x=t.y*e.z-t.z*e.y,this._y=t.z*e.x-t.x*e.z,this._z=t.x*e.y-t.y*e.x,this._w=n),this.normalize()}angleTo(t){return 2*Math.acos(Math.abs(Rn(this.dot(t),-1,1)))}rotateTowards(t,e){const n=this.angleTo(t);if(n===0)return this;const s=Math.min(1,e/n);return this.slerp(t,s),this}identity(){return this.set(0,0,0,1)}invert(){return this.conjugate()}conjugate(){return this._x*=-1,this._y*=-1,this._z*=-1,this._onChangeCallback(),this}dot(t){return this._x*t._x+this._y*t._y+this._z*t._z+this._w*t._w}lengthSq(){return this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w}length(){return Math.sqrt(this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w)}normalize(){let t=this.length();return t===0?(this._x=0,this._y=0,this._z=0,this._w=1):(t=1/t,this._x=this._x*t,this._y=this._y*t,this._z=this._z*t,this._w=this._w*t),this._onChangeCallback(),this}multiply(t){return this.multiplyQuaternions(this,t)}premultiply(t){return this.multiplyQuaternions(t,this)}multiplyQuaternions(t,e){const n=t._x,s=t._y,r=t._z,o=t._w,a=e._x,l=e._y,c=e._z,u=e._w;return this._x=n*u+o*a+s*c-r*l,this._y=s*u+o*l+r*a-n*c,this._z=r*u+o*c+n*l-s*a,this._w=o*u-n*a-s*l-r*c,this._onChangeCallback(),this}slerp(t,e){if(e===0)return this;if(e===1)return this.copy(t);const n=this._x,s=this._y,r=this._z,o=this._w;let a=o*t._w+n*t._x+s*t._y+r*t._z;if(a<0?(this._w=-t._w,this._x=-t._x,this._y=-t._y,this._z=-t._z,a=-a):this.copy(t),a>=1)return this._w=o,this._x=n,this._y=s,this._z=r,this;const l=1-a*a;if(l<=Number.EPSILON){const _=1-e;return this._w=_*o+e*this._w,this._x=_*n+e*this._x,this._y=_*s+e*this._y,this._z=_*r+e*this._z,this.normalize(),this}const c=Math.sqrt(l),u=Math.atan2(c,a),f=Math.sin((1-e)*u)/c,h=Math.sin(e*u)/c;return this._w=o*f+this._w*h,this._x=n*f+this._x*h,this._y=s*f+this._y*h,this._z=r*f+this._z*h,this._onChangeCallback(),this}slerpQuaternions(t,e,n){return this.copy(t).slerp(e,n)}random(){const t=2*Math.PI*Math.random(),e=2*Math.PI*Math.random(),n=Math.random(),s=Math.sqrt(1-n),r=Math.sqrt(n);return this.set(s*Math.sin(t),s*Math.cos(t),r*Math.sin(e),r*Math.cos(e))}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._w===this._w}fromArray(t,e=0){return this._x=t[e],this._y=t[e+1],this._z=t[e+2],this._w=t[e+3],this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._w,t}fromBufferAttribute(t,e){return this._x=t.getX(e),this._y=t.getY(e),this._z=t.getZ(e),this._w=t.getW(e),this._onChangeCallback(),this}toJSON(){return this.toArray()}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._w}}class ${constructor(t=0,e=0,n=0){$.prototype.isVector3=!0,this.x=t,this.y=e,this.z=n}set(t,e,n){return n===void 0&&(n=this.z),this.x=t,this.y=e,this.z=n,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;default:throw new Error("index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;default:throw new Error("index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this}multiplyVectors(t,e){return this.x=t.x*e.x,this.y=t.y*e.y,this.z=t.z*e.z,this}applyEuler(t){return this.applyQuaternion(Uu.setFromEuler(t))}applyAxisAngle(t,e){return this.applyQuaternion(Uu.setFromAxisAngle(t,e))}applyMatrix3(t){const e=this.x,n=this.y,s=this.z,r=t.elements;return this.x=r[0]*e+r[3]*n+r[6]*s,this.y=r[1]*e+r[4]*n+r[7]*s,this.z=r[2]*e+r[5]*n+r[8]*s,this}applyNormalMatrix(t){return this.applyMatrix3(t).normalize()}applyMatrix4(t){const e=this.x,n=this.y,s=this.z,r=t.elements,o=1/(r[3]*e+r[7]*n+r[11]*s+r[15]);return this.x=(r[0]*e+r[4]*n+r[8]*s+r[12])*o,this.y=(r[1]*e+r[5]*n+r[9]*s+r[13])*o,this.z=(r[2]*e+r[6]*n+r[10]*s+r[14])*o,this}applyQuaternion(t){const e=this.x,n=this.y,s=this.z,r=t.x,o=t.y,a=t.z,l=t.w,c=2*(o*s-a*n),u=2*(a*e-r*s),f=2*(r*n-o*e);return this.x=e+l*c+o*f-a*u,this.y=n+l*u+a*c-r*f,this.z=s+l*f+r*u-o*c,this}project(t){return this.applyMatrix4(t.matrixWorldInverse).applyMatrix4(t.projectionMatrix)}unproject(t){return this.applyMatrix4(t.projectionMatrixInverse).applyMatrix4(t.matrixWorld)}transformDirection(t){const e=this.x,n=this.y,s=this.z,r=t.elements;return this.x=r[0]*e+r[4]*n+r[8]*s,this.y=r[1]*e+r[5]*n+r[9]*s,this.z=r[2]*e+r[6]*n+r[10]*s,this.normalize()}divide(t){return this.x/=t.x,this.y/=t.y,this.z/=t.z,this}divideScalar(t){return this.multiplyScalar(1/t)}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this}clamp(t,e){return this.x=Math.max(t.x,Math.min(e.x,this.x)),this.y=Math.max(t.y,Math.min(e.y,this.y)),this.z=Math.max(t.z,Math.min(e.z,this.z)),this}clampScalar(t,e){return this.x=Math.max(t,Math.min(e,this.x)),this.y=Math.max(t,Math.min(e,this.y)),this.z=Math.max(t,Math.min(e,this.z)),this}clampLength(t,e){const n=this.length();return this.divideScalar(n||1).multiplyScalar(Math.max(t,Math.min(e,n)))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this}lerpVectors(t,e,n){return this.x=t.x+(e.x-t.x)*n,this.y=t.y+(e.y-t.y)*n,this.z=t.z+(e.z-t.z)*n,this}cross(t){return this.crossVectors(this,t)}crossVectors(t,e){const n=t.x,s=t.y,r=t.z,o=e.x,a=e.y,l=e.z;return this.x=s*l-r*a,this.y=r*o-n*l,this.z=n*a-s*o,this}projectOnVector(t){const e=t.lengthSq();if(e===0)return this.set(0,0,0);const n=t.dot(this)/e;return this.copy(t).multiplyScalar(n)}projectOnPlane(t){return Sl.copy(this).projectOnVector(t),this.sub(Sl)}reflect(t){return this.sub(Sl.copy(t).multiplyScalar(2*this.dot(t)))}angleTo(t){const e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;const n=this.dot(t)/e;return Math.acos(Rn(n,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){const e=this.x-t.x,n=this.y-t.y,s=this.z-t.z;return e*e+n*n+s*s}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)+Math.abs(this.z-t.z)}setFromSpherical(t){return this.setFromSphericalCoords(t.radius,t.phi,t.theta)}setFromSphericalCoords(t,e,n){const s=Math.sin(e)*t;return this.x=s*Math.sin(n),this.y=Math.cos(e)*t,this.z=s*Math.cos(n),this}setFromCylindrical(t){return this.setFromCylindricalCoords(t.radius,t.theta,t.y)}setFromCylindricalCoords(t,e,n){return this.x=t*Math.sin(e),this.y=n,this.z=t*Math.cos(e),this}setFromMatrixPosition(t){const e=t.elements;return this.x=e[12],this.y=e[13],this.z=e[14],this}setFromMatrixScale(t){const e=this.setFromMatrixColumn(t,0).length(),n=this.setFromMatrixColumn(t,1).length(),s=this.setFromMatrixColumn(t,2).length();return this.x=e,this.y=n,this.z=s,this}setFromMatrixColumn(t,e){return this.fromArray(t.elements,e*4)}setFromMatrix3Column(t,e){return this.fromArray(t.elements,e*3)}setFromEuler(t){return this.x=t._x,this.y=t._y,this.z=t._z,this}setFromColor(t){return this.x=t.r,this.y=t.g,this.z=t.b,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this}randomDirection(){const t=Math.random()*Math.PI*2,e=Math.random()*2-1,n=Math.sqrt(1-e*e);return this.x=n*Math.cos(t),this.y=e,this.z=n*Math.sin(t),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z}}const Sl=new $,Uu=new Os;class To{constructor(t=new $(1/0,1/0,1/0),e=new $(-1/0,-1/0,-1/0)){this.isBox3=!0,this.min=t,this.max=e}set(t,e){return this.min.copy(t),this.max.copy(e),this}setFromArray(t){this.makeEmpty();for(let e=0,n=t.length;e<n;e+=3)this.expandByPoint(ri.fromArray(t,e));return this}setFromBufferAttribute(t){this.makeEmpty();for(let e=0,n=t.count;e<n;e++)this.expandByPoint(ri.fromBufferAttribute(t,e));return this}setFromPoints(t){this.makeEmpty();for(let e=0,n=t.length;e<n;e++)this.expandByPoint(t[e]);return this}setFromCenterAndSize(t,e){const n=ri.copy(e).multiplyScalar(.5);return this.min.copy(t).sub(n),this.max.copy(t).add(n),this}setFromObject(t,e=!1){return this.makeEmpty(),this.expandByObject(t,e)}clone(){return new this.constructor().copy(this)}copy(t){return this.min.copy(t.min),this.max.copy(t.max),this}makeEmpty(){return this.min.x=this.min.y=this.min.z=1/0,this.max.x=this.max.y=this.max.z=-1/0,this}isEmpty(){return this.max.x<this.min.x||this.max.y<this.min.y||this.max.z<this.min.z}getCenter(t){return this.isEmpty()?t.set(0,0,0):t.addVectors(this.min,this.max).multiplyScalar(.5)}getSize(t){return this.isEmpty()?t.set(0,0,0):t.subVectors(this.max,this.min)}expandByPoint(t){return this.min.min(t),this.max.max(t),this}expandByVector(t){return this.min.sub(t),this.max.add(t),this}expandByScalar(t){return this.min.addScalar(-t),this.max.addScalar(t),this}expandByObject(t,e=!1){t.updateWorldMatrix(!1,!1);const n=t.geometry;if(n!==void 0){const r=n.getAttribute("position");if(e===!0&&r!==void 0&&t.isInstancedMesh!==!0)for(let o=0,a=r.count;o<a;o++)t.isMesh===!0?t.getVertexPosition(o,ri):ri.fromBufferAttribute(r,o),ri.applyMatrix4(t.matrixWorld),this.expandByPoint(ri);else t.boundingBox!==void 0?(t.boundingBox===null&&t.computeBoundingBox(),Bo.copy(t.boundingBox)):(n.boundingBox===null&&n.computeBoundingBox(),Bo.copy(n.boundingBox)),Bo.applyMatrix4(t.matrixWorld),this.union(Bo)}const s=t.children;for(let r=0,o=s.length;r<o;r++)this.expandByObject(s[r],e);return this}containsPoint(t){return t.x>=this.min.x&&t.x<=this.max.x&&t.y>=this.min.y&&t.y<=this.max.y&&t.z>=this.min.z&&t.z<=this.max.z}containsBox(t){return this.min.x<=t.min.x&&t.max.x<=this.max.x&&this.min.y<=t.min.y&&t.max.y<=this.max.y&&this.min.z<=t.min.z&&t.max.z<=this.max.z}getParameter(t,e){return e.set((t.x-this.min.x)/(this.max.x-this.min.x),(t.y-this.min.y)/(this.max.y-this.min.y),(t.z-this.min.z)/(this.max.z-this.min.z))}intersectsBox(t){return t.max.x>=this.min.x&&t.min.x<=this.max.x&&t.max.y>=this.min.y&&t.min.y<=this.max.y&&t.max.z>=this.min.z&&t.min.z<=this.max.z}intersectsSphere(t){return this.clampPoint(t.center,ri),ri.distanceToSquared(t.center)<=t.radius*t.radius}intersectsPlane(t){let e,n;return t.normal.x>0?(e=t.normal.x*this.min.x,n=t.normal.x*this.max.x):(e=t.normal.x*this.max.x,n=t.normal.x*this.min.x),t.normal.y>0?(e+=t.normal.y*this.min.y,n+=t.normal.y*this.max.y):(e+=t.normal.y*this.max.y,n+=t.normal.y*this.min.y),t.normal.z>0?(e+=t.normal.z*this.min.z,n+=t.normal.z*this.max.z):(e+=t.normal.z*this.max.z,n+=t.normal.z*this.min.z),e<=-t.constant&&n>=-t.constant}intersectsTriangle(t){if(this.isEmpty())return!1;this.getCenter(no),zo.subVectors(this.max,no),nr.subVectors(t.a,no),ir.subVectors(t.b,no),sr.subVectors(t.c,no),Yi.subVectors(ir,nr),ji.subVectors(sr,ir),_s.subVectors(nr,sr);let e=[0,-Yi.z,Yi.y,0,-ji.z,ji.y,0,-_s.z,_s.y,Yi.z,0,-Yi.x,ji.z,0,-ji.x,_s.z,0,-_s.x,-Yi.y,Yi.x,0,-ji.y,ji.x,0,-_s.y,_s.x,0];return!El(e,nr,ir,sr,zo)||(e=[1,0,0,0,1,0,0,0,1],!El(e,nr,ir,sr,zo))?!1:(Ho.crossVectors(Yi,ji),e=[Ho.x,Ho.y,Ho.z],El(e,nr,ir,sr,zo))}clampPoint(t,e){return e.copy(t).clamp(this.min,this.max)}distanceToPoint(t){return this.clampPoint(t,ri).distanceTo(t)}getBoundingSphere(t){return this.isEmpty()?t.makeEmpty():(this.getCenter(t.center),t.radius=this.getSize(ri).length()*.5),t}intersect(t){return this.min.max(t.min),this.max.min(t.max),this.isEmpty()&&this.makeEmpty(),this}union(t){return this.min.min(t.min),this.max.max(t.max),this}applyMatrix4(t){return this.isEmpty()?this:(Pi[0].set(this.min.x,this.min.y,this.min.z).applyMatrix4(t),Pi[1].set(this.min.x,this.min.y,this.max.z).applyMatrix4(t),Pi[2].set(this.min.x,this.max.y,this.min.z).applyMatrix4(t),Pi[3].set(this.min.x,this.max.y,this.max.z).applyMatrix4(t),Pi[4].set(this.max.x,this.min.y,this.min.z).applyMatrix4(t),Pi[5].set(this.max.x,this.min.y,this.max.z).applyMatrix4(t),Pi[6].set(this.max.x,this.max.y,this.min.z).applyMatrix4(t),Pi[7].set(this.max.x,this.max.y,this.max.z).applyMatrix4(t),this.setFromPoints(Pi),this)}translate(t){return this.min.add(t),this.max.add(t),this}equals(t){return t.min.equals(this.min)&&t.max.equals(this.max)}}const Pi=[new $,new $,new $,new $,new $,new $,new $,new $],ri=new $,Bo=new To,nr=new $,ir=new $,sr=new $,Yi=new $,ji=new $,_s=new $,no=new $,zo=new $,Ho=new $,vs=new $;function El(i,t,e,n,s){for(let r=0,o=i.length-3;r<=o;r+=3){vs.fromArray(i,r);const a=s.x*Math.abs(vs.x)+s.y*Math.abs(vs.y)+s.z*Math.abs(vs.z),l=t.dot(vs),c=e.dot(vs),u=n.dot(vs);if(Math.max(-Math.max(l,c,u),Math.min(l,c,u))>a)return!1}return!0}const b_=new To,io=new $,wl=new $;class Va{constructor(t=new $,e=-1){this.isSphere=!0,this.center=t,this.radius=e}set(t,e){return this.center.copy(t),this.radius=e,this}setFromPoints(t,e){const n=this.center;e!==void 0?n.copy(e):b_.setFromPoints(t).getCenter(n);let s=0;for(let r=0,o=t.length;r<o;r++)s=Math.max(s,n.distanceToSquared(t[r]));return this.radius=Math.sqrt(s),this}copy(t){return this.center.copy(t.center),this.radius=t.radius,this}isEmpty(){return this.radius<0}makeEmpty(){return this.center.set(0,0,0),this.radius=-1,this}containsPoint(t){return t.distanceToSquared(this.center)<=this.radius*this.radius}distanceToPoint(t){return t.distanceTo(this.center)-this.radius}intersectsSphere(t){const e=this.radius+t.radius;return t.center.distanceToSquared(this.center)<=e*e}intersectsBox(t){return t.intersectsSphere(this)}intersectsPlane(t){return Math.abs(t.distanceToPoint(this.center))<=this.radius}clampPoint(t,e){const n=this.center.distanceToSquared(t);return e.copy(t),n>this.radius*this.radius&&(e.sub(this.center).normalize(),e.multiplyScalar(this.radius).add(this.center)),e}getBoundingBox(t){return this.isEmpty()?(t.makeEmpty(),t):(t.set(this.center,this.center),t.expandByScalar(this.radius),t)}applyMatrix4(t){return this.center.applyMatrix4(t),this.radius=this.radius*t.getMaxScaleOnAxis(),this}translate(t){return this.center.add(t),this}expandByPoint(t){if(this.isEmpty())return this.center.copy(t),this.radius=0,this;io.subVectors(t,this.center);const e=io.lengthSq();if(e>this.radius*this.radius){const n=Math.sqrt(e),s=(n-this.radius)*.5;this.center.addScaledVector(io,s/n),this.radius+=s}return this}union(t){return t.isEmpty()?this:this.isEmpty()?(this.copy(t),this):(this.center.equals(t.center)===!0?this.radius=Math.max(this.radius,t.radius):(wl.subVectors(t.center,this.center).setLength(t.radius),this.expandByPoint(io.copy(t.center).add(wl)),this.expandByPoint(io.copy(t.center).sub(wl))),this)}equals(t){return t.center.equals(this.center)&&t.radius===this.radius}clone(){return new this.constructor().copy(this)}}const Li=new $,bl=new $,Go=new $,Ki=new $,Tl=new $,Vo=new $,Al=new $;class wh{constructor(t=new $,e=new $(0,0,-1)){this.origin=t,this.direction=e}set(t,e){return this.origin.copy(t),this.direction.copy(e),this}copy(t){return this.origin.copy(t.origin),this.direction.copy(t.direction),this}at(t,e){return e.copy(this.origin).addScaledVector(this.direction,t)}lookAt(t){return this.direction.copy(t).sub(this.origin).normalize(),this}recast(t){return this.origin.copy(this.at(t,Li)),this}closestPointToPoint(t,e){e.subVectors(t,this.origin);const n=e.dot(this.direction);return n<0?e.copy(this.origin):e.copy(this.origin).addScaledVector(this.direction,n)}distanceToPoint(t){return Math.sqrt(this.distanceSqToPoint(t))}distanceSqToPoint(t){const e=Li.subVectors(t,this.origin).dot(this.direction);return e<0?this.origin.distanceToSquared(t):(Li.copy(this.origin).addScaledVector(this.direction,e),Li.distanceToSquared(t))}distanceSqToSegment(t,e,n,s){bl.copy(t).add(e).multiplyScalar(.5),Go.copy(e).sub(t).normalize(),Ki.copy(this.origin).sub(bl);const r=t.distanceTo(e)*.5,o=-this.direction.dot(Go),a=Ki.dot(this.direction),l=-Ki.dot(Go),c=Ki.lengthSq(),u=Math.abs(1-o*o);let f,h,_,x;if(u>0)if(f=o*l-a,h=o*a-l,x=r*u,f>=0)if(h>=-x)if(h<=x){const M=1/u;f*=M,h*=M,_=f*(f+o*h+2*a)+h*(o*f+h+2*l)+c}else h=r,f=Math.max(0,-(o*h+a)),_=-f*f+h*(h+2*l)+c;else h=-r,f=Math.max(0,-(o*h+a)),_=-f*f+h*(h+2*l)+c;else h<=-x?(f=Math.max(0,-(-o*r+a)),h=f>0?-r:Math.min(Math.max(-r,-l),r),_=-f*f+h*(h+2*l)+c):h<=x?(f=0,h=Math.min(Math.max(-r,-l),r),_=h*(h+2*l)+c):(f=Math.max(0,-(o*r+a)),h=f>0?r:Math.min(Math.max(-r,-l),r),_=-f*f+h*(h+2*l)+c);else h=o>0?-r:r,f=Math.max(0,-(o*h+a)),_=-f*f+h*(h+2*l)+c;return n&&n.copy(this.origin).addScaledVector(this.direction,f),s&&s.copy(bl).addScaledVector(Go,h),_}intersectSphere(t,e){Li.subVectors(t.center,this.origin);const n=Li.dot(this.direction),s=Li.dot(Li)-n*n,r=t.radius*t.radius;if(s>r)return null;const o=Math.sqrt(r-s),a=n-o,l=n+o;return l<0?null:a<0?this.at(l,e):this.at(a,e)}intersectsSphere(t){return this.distanceSqToPoint(t.center)<=t.radius*t.radius}distanceToPlane(t){const e=t.normal.dot(this.direction);if(e===0)return t.distanceToPoint(this.origin)===0?0:null;const n=-(this.origin.dot(t.normal)+t.constant)/e;return n>=0?n:null}intersectPlane(t,e){const n=this.distanceToPlane(t);return n===null?null:this.at(n,e)}intersectsPlane(t){const e=t.distanceToPoint(this.origin);return e===0||t.normal.dot(this.direction)*e<0}intersectBox(t,e){let n,s,r,o,a,l;const c=1/this.direction.x,u=1/this.direction.y,f=1/this.direction.z,h=this.origin;return c>=0?(n=(t.min.x-h.x)*c,s=(t.max.x-h.x)*c):(n=(t.max.x-h.x)*c,s=(t.min.x-h.x)*c),u>=0?(r=(t.min.y-h.y)*u,o=(t.max.y-h.y)*u):(r=(t.max.y-h.y)*u,o=(t.min.y-h.y)*u),n>o||r>s||((r>n||isNaN(n))&&(n=r),(o<s||isNaN(s))&&(s=o),f>=0?(a=(t.min.z-h.z)*f,l=(t.max.z-h.z)*f):(a=(t.max.z-h.z)*f,l=(t.min.z-h.z)*f),n>l||a>s)||((a>n||n!==n)&&(n=a),(l<s||s!==s)&&(s=l),s<0)?null:this.at(n>=0?n:s,e)}intersectsBox(t){return this.intersectBox(t,Li)!==null}intersectTriangle(t,e,n,s,r){Tl.subVectors(e,t),Vo.subVectors(n,t),Al.crossVectors(Tl,Vo);let o=this.direction.dot(Al),a;if(o>0){if(s)return null;a=1}else if(o<0)a=-1,o=-o;else return null;Ki.subVectors(this.origin,t);const l=a*this.direction.dot(Vo.crossVectors(Ki,Vo));if(l<0)return null;const c=a*this.direction.dot(Tl.cross(Ki));if(c<0||l+c>o)return null;const u=-a*Ki.dot(Al);return u<0?null:this.at(u/o,r)}applyMatrix4(t){return this.origin.applyMatrix4(t),this.direction.transformDirection(t),this}equals(t){return t.origin.equals(this.origin)&&t.direction.equals(this.direction)}clone(){return new this.constructor().copy(this)}}class Ge{constructor(t,e,n,s,r,o,a,l,c,u,f,h,_,x,M,p){Ge.prototype.isMatrix4=!0,this.elements=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],t!==void 0&&this.set(t,e,n,s,r,o,a,l,c,u,f,h,_,x,M,p)}set(t,e,n,s,r,o,a,l,c,u,f,h,_,x,M,p){const d=this.elements;return d[0]=t,d[4]=e,d[8]=n,d[12]=s,d[1]=r,d[5]=o,d[9]=a,d[13]=l,d[2]=c,d[6]=u,d[10]=f,d[14]=h,d[3]=_,d[7]=x,d[11]=M,d[15]=p,this}identity(){return this.set(1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1),this}clone(){return new Ge().fromArray(this.elements)}copy(t){const e=this.elements,n=t.elements;return e[0]=n[0],e[1]=n[1],e[2]=n[2],e[3]=n[3],e[4]=n[4],e[5]=n[5],e[6]=n[6],e[7]=n[7],e[8]=n[8],e[9]=n[9],e[10]=n[10],e[11]=n[11],e[12]=n[12],e[13]=n[13],e[14]=n[14],e[15]=n[15],this}copyPosition(t){const e=this.elements,n=t.elements;return e[12]=n[12],e[13]=n[13],e[14]=n[14],this}setFromMatrix3(t){const e=t.elements;return this.set(e[0],e[3],e[6],0,e[1],e[4],e[7],0,e[2],e[5],e[8],0,0,0,0,1),this}extractBasis(t,e,n){return t.setFromMatrixColumn(this,0),e.setFromMatrixColumn(this,1),n.setFromMatrixColumn(this,2),this}makeBasis(t,e,n){return this.set(t.x,e.x,n.x,0,t.y,e.y,n.y,0,t.z,e.z,n.z,0,0,0,0,1),this}extractRotation(t){const e=this.elements,n=t.elements,s=1/rr.setFromMatrixColumn(t,0).length(),r=1/rr.setFromMatrixColumn(t,1).length(),o=1/rr.setFromMatrixColumn(t,2).length();return e[0]=n[0]*s,e[1]=n[1]*s,e[2]=n[2]*s,e[3]=0,e[4]=n[4]*r,e[5]=n[5]*r,e[6]=n[6]*r,e[7]=0,e[8]=n[8]*o,e[9]=n[9]*o,e[10]=n[10]*o,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromEuler(t){const e=this.elements,n=t.x,s=t.y,r=t.z,o=Math.cos(n),a=Math.sin(n),l=Math.cos(s),c=Math.sin(s),u=Math.cos(r),f=Math.sin(r);if(t.order==="XYZ"){const h=o*u,_=o*f,x=a*u,M=a*f;e[0]=l*u,e[4]=-l*f,e[8]=c,e[1]=_+x*c,e[5]=h-M*c,e[9]=-a*l,e[2]=M-h*c,e[6]=x+_*c,e[10]=o*l}else if(t.order==="YXZ"){const h=l*u,_=l*f,x=c*u,M=c*f;e[0]=h+M*a,e[4]=x*a-_,e[8]=o*c,e[1]=o*f,e[5]=o*u,e[9]=-a,e[2]=_*a-x,e[6]=M+h*a,e[10]=o*l}else if(t.order==="ZXY"){const h=l*u,_=l*f,x=c*u,M=c*f;e[0]=h-M*a,e[4]=-o*f,e[8]=x+_*a,e[1]=_+x*a,e[5]=o*u,e[9]=M-h*a,e[2]=-o*c,e[6]=a,e[10]=o*l}else if(t.order==="ZYX"){const h=o*u,_=o*f,x=a*u,M=a*f;e[0]=l*u,e[4]=x*c-_,e[8]=h*c+M,e[1]=l*f,e[5]=M*c+h,e[9]=_*c-x,e[2]=-c,e[6]=a*l,e[10]=o*l}else if(t.order==="YZX"){const h=o*l,_=o*c,x=a*l,M=a*c;e[0]=l*u,e[4]=M-h*f,e[8]=x*f+_,e[1]=f,e[5]=o*u,e[9]=-a*u,e[2]=-c*u,e[6]=_*f+x,e[10]=h-M*f}else if(t.order==="XZY"){const h=o*l,_=o*c,x=a*l,M=a*c;e[0]=l*u,e[4]=-f,e[8]=c*u,e[1]=h*f+M,e[5]=o*u,e[9]=_*f-x,e[2]=x*f-_,e[6]=a*u,e[10]=M*f+h}return e[3]=0,e[7]=0,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromQuaternion(t){return this.compose(T_,t,A_)}lookAt(t,e,n){const s=this.elements;return Fn.subVectors(t,e),Fn.lengthSq()===0&&(Fn.z=1),Fn.normalize(),$i.crossVectors(n,Fn),$i.lengthSq()===0&&(Math.abs(n.z)===1?Fn.x+=1e-4:Fn.z+=1e-4,Fn.normalize(),$i.crossVectors(n,Fn)),$i.normalize(),Wo.crossVectors(Fn,$i),s[0]=$i.x,s[4]=Wo.x,s[8]=Fn.x,s[1]=$i.y,s[5]=Wo.y,s[9]=Fn.y,s[2]=$i.z,s[6]=Wo.z,s[10]=Fn.z,this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){const n=t.elements,s=e.elements,r=this.elements,o=n[0],a=n[4],l=n[8],c=n[12],u=n[1],f=n[5],h=n[9],_=n[13],x=n[2],M=n[6],p=n[10],d=n[14],C=n[3],b=n[7],R=n[11],D=n[15],A=s[0],y=s[4],P=s[8],O=s[12],g=s[1],m=s[5],E=s[9],N=s[13],F=s[2],B=s[6],G=s[10],K=s[14],Q=s[3],dt=s[7],ct=s[11],gt=s[15];return r[0]=o*A+a*g+l*F+c*Q,r[4]=o*y+a*m+l*B+c*dt,r[8]=o*P+a*E+l*G+c*ct,r[12]=o*O+a*N+l*K+c*gt,r[1]=u*A+f*g+h*F+_*Q,r[5]=u*y+f*m+h*B+_*dt,r[9]=u*P+f*E+h*G+_*ct,r[13]=u*O+f*N+h*K+_*gt,r[2]=x*A+M*g+p*F+d*Q,r[6]=x*y+M*m+p*B+d*dt,r[10]=x*P+M*E+p*G+d*ct,r[14]=x*O+M*N+p*K+d*gt,r[3]=C*A+b*g+R*F+D*Q,r[7]=C*y+b*m+R*B+D*dt,r[11]=C*P+b*E+R*G+D*ct,r[15]=C*O+b*N+R*K+D*gt,this}multiplyScalar(t){const e=this.elements;return e[0]*=t,e[4]*=t,e[8]*=t,e[12]*=t,e[1]*=t,e[5]*=t,e[9]*=t,e[13]*=t,e[2]*=t,e[6]*=t,e[10]*=t,e[14]*=t,e[3]*=t,e[7]*=t,e[11]*=t,e[15]*=t,this}determinant(){const t=this.elements,e=t[0],n=t[4],s=t[8],r=t[12],o=t[1],a=t[5],l=t[9],c=t[13],u=t[2],f=t[6],h=t[10],_=t[14],x=t[3],M=t[7],p=t[11],d=t[15];return x*(+r*l*f-s*c*f-r*a*h+n*c*h+s*a*_-n*l*_)+M*(+e*l*_-e*c*h+r*o*h-s*o*_+s*c*u-r*l*u)+p*(+e*c*f-e*a*_-r*o*f+n*o*_+r*a*u-n*c*u)+d*(-s*a*u-e*l*f+e*a*h+s*o*f-n*o*h+n*l*u)}transpose(){const t=this.elements;let e;return e=t[1],t[1]=t[4],t[4]=e,e=t[2],t[2]=t[8],t[8]=e,e=t[6],t[6]=t[9],t[9]=e,e=t[3],t[3]=t[12],t[12]=e,e=t[7],t[7]=t[13],t[13]=e,e=t[11],t[11]=t[14],t[14]=e,this}setPosition(t,e,n){const s=this.elements;return t.isVector3?(s[12]=t.x,s[13]=t.y,s[14]=t.z):(s[12]=t,s[13]=e,s[14]=n),this}invert(){const t=this.elements,e=t[0],n=t[1],s=t[2],r=t[3],o=t[4],a=t[5],l=t[6],c=t[7],u=t[8],f=t[9],h=t[10],_=t[11],x=t[12],M=t[13],p=t[14],d=t[15],C=f*p*c-M*h*c+M*l*_-a*p*_-f*l*d+a*h*d,b=x*h*c-u*p*c-x*l*_+o*p*_+u*l*d-o*h*d,R=u*M*c-x*f*c+x*a*_-o*M*_-u*a*d+o*f*d,D=x*f*l-u*M*l-x*a*h+o*M*h+u*a*p-o*f*p,A=e*C+n*b+s*R+r*D;if(A===0)return this.set(0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0);const y=1/A;return t[0]=C*y,t[1]=(M*h*r-f*p*r-M*s*_+n*p*_+f*s*d-n*h*d)*y,t[2]=(a*p*r-M*l*r+M*s*c-n*p*c-a*s*d+n*l*d)*y,t[3]=(f*l*r-a*h*r-f*s*c+n*h*c+a*s*_-n*l*_)*y,t[4]=b*y,t[5]=(u*p*r-x*h*r+x*s*_-e*p*_-u*s*d+e*h*d)*y,t[6]=(x*l*r-o*p*r-x*s*c+e*p*c+o*s*d-e*l*d)*y,t[7]=(o*h*r-u*l*r+u*s*c-e*h*c-o*s*_+e*l*_)*y,t[8]=R*y,t[9]=(x*f*r-u*M*r-x*n*_+e*M*_+u*n*d-e*f*d)*y,t[10]=(o*M*r-x*a*r+x*n*c-e*M*c-o*n*d+e*a*d)*y,t[11]=(u*a*r-o*f*r-u*n*c+e*f*c+o*n*_-e*a*_)*y,t[12]=D*y,t[13]=(u*M*s-x*f*s+x*n*h-e*M*h-u*n*p+e*f*p)*y,t[14]=(x*a*s-o*M*s-x*n*l+e*M*l+o*n*p-e*a*p)*y,t[15]=(o*f*s-u*a*s+u*n*l-e*f*l-o*n*h+e*a*h)*y,this}scale(t){const e=this.elements,n=t.x,s=t.y,r=t.z;return e[0]*=n,e[4]*=s,e[8]*=r,e[1]*=n,e[5]*=s,e[9]*=r,e[2]*=n,e[6]*=s,e[10]*=r,e[3]*=n,e[7]*=s,e[11]*=r,this}getMaxScaleOnAxis(){const t=this.elements,e=t[0]*t[0]+t[1]*t[1]+t[2]*t[2],n=t[4]*t[4]+t[5]*t[5]+t[6]*t[6],s=t[8]*t[8]+t[9]*t[9]+t[10]*t[10];return Math.sqrt(Math.max(e,n,s))}makeTranslation(t,e,n){return t.isVector3?this.set(1,0,0,t.x,0,1,0,t.y,0,0,1,t.z,0,0,0,1):this.set(1,0,0,t,0,1,0,e,0,0,1,n,0,0,0,1),this}makeRotationX(t){const e=Math.cos(t),n=Math.sin(t);return this.set(1,0,0,0,0,e,-n,0,0,n,e,0,0,0,0,1),this}makeRotationY(t){const e=Math.cos(t),n=Math.sin(t);return this.set(e,0,n,0,0,1,0,0,-n,0,e,0,0,0,0,1),this}makeRotationZ(t){const e=Math.cos(t),n=Math.sin(t);return this.set(e,-n,0,0,n,e,0,0,0,0,1,0,0,0,0,1),this}makeRotationAxis(t,e){const n=Math.cos(e),s=Math.sin(e),r=1-n,o=t.x,a=t.y,l=t.z,c=r*o,u=r*a;return this.set(c*o+n,c*a-s*l,c*l+s*a,0,c*a+s*l,u*a+n,u*l-s*o,0,c*l-s*a,u*l+s*o,r*l*l+n,0,0,0,0,1),this}makeScale(t,e,n){return this.set(t,0,0,0,0,e,0,0,0,0,n,0,0,0,0,1),this}makeShear(t,e,n,s,r,o){return this.set(1,n,r,0,t,1,o,0,e,s,1,0,0,0,0,1),this}compose(t,e,n){const s=this.elements,r=e._x,o=e._y,a=e._z,l=e._w,c=r+r,u=o+o,f=a+a,h=r*c,_=r*u,x=r*f,M=o*u,p=o*f,d=a*f,C=l*c,b=l*u,R=l*f,D=n.x,A=n.y,y=n.z;return s[0]=(1-(M+d))*D,s[1]=(_+R)*D,s[2]=(x-b)*D,s[3]=0,s[4]=(_-R)*A,s[5]=(1-(h+d))*A,s[6]=(p+C)*A,s[7]=0,s[8]=(x+b)*y,s[9]=(p-C)*y,s[10]=(1-(h+M))*y,s[11]=0,s[12]=t.x,s[13]=t.y,s[14]=t.z,s[15]=1,this}decompose(t,e,n){const s=this.elements;let r=rr.set(s[0],s[1],s[2]).length();const o=rr.set(s[4],s[5],s[6]).length(),a=rr.set(s[8],s[9],s[10]).length();this.determinant()<0&&(r=-r),t.x=s[12],t.y=s[13],t.z=s[14],oi.copy(this);const c=1/r,u=1/o,f=1/a;return oi.elements[0]*=c,oi.elements[1]*=c,oi.elements[2]*=c,oi.elements[4]*=u,oi.elements[5]*=u,oi.elements[6]*=u,oi.elements[8]*=f,oi.elements[9]*=f,oi.elements[10]*=f,e.setFromRotationMatrix(oi),n.x=r,n.y=o,n.z=a,this}makePerspective(t,e,n,s,r,o,a=Fi){const l=this.elements,c=2*r/(e-t),u=2*r/(n-s),f=(e+t)/(e-t),h=(n+s)/(n-s);let _,x;if(a===Fi)_=-(o+r)/(o-r),x=-2*o*r/(o-r);else if(a===Ia)_=-o/(o-r),x=-o*r/(o-r);else throw new Error("THREE.Matrix4.makePerspective(): Invalid coordinate system: "+a);return l[0]=c,l[4]=0,l[8]=f,l[12]=0,l[1]=0,l[5]=u,l[9]=h,l[13]=0,l[2]=0,l[6]=0,l[10]=_,l[14]=x,l[3]=0,l[7]=0,l[11]=-1,l[15]=0,this}makeOrthographic(t,e,n,s,r,o,a=Fi){const l=this.elements,c=1/(e-t),u=1/(n-s),f=1/(o-r),h=(e+t)*c,_=(n+s)*u;let x,M;if(a===Fi)x=(o+r)*f,M=-2*f;else if(a===Ia)x=r*f,M=-1*f;else throw new Error("THREE.Matrix4.makeOrthographic(): Invalid coordinate system: "+a);return l[0]=2*c,l[4]=0,l[8]=0,l[12]=-h,l[1]=0,l[5]=2*u,l[9]=0,l[13]=-_,l[2]=0,l[6]=0,l[10]=M,l[14]=-x,l[3]=0,l[7]=0,l[11]=0,l[15]=1,this}equals(t){const e=this.elements,n=t.elements;for(let s=0;s<16;s++)if(e[s]!==n[s])return!1;return!0}fromArray(t,e=0){for(let n=0;n<16;n++)this.elements[n]=t[n+e];return this}toArray(t=[],e=0){const n=this.elements;return t[e]=n[0],t[e+1]=n[1],t[e+2]=n[2],t[e+3]=n[3],t[e+4]=n[4],t[e+5]=n[5],t[e+6]=n[6],t[e+7]=n[7],t[e+8]=n[8],t[e+9]=n[9],t[e+10]=n[10],t[e+11]=n[11],t[e+12]=n[12],t[e+13]=n[13],t[e+14]=n[14],t[e+15]=n[15],t}}const rr=new $,oi=new Ge,T_=new $(0,0,0),A_=new $(1,1,1),$i=new $,Wo=new $,Fn=new $,Nu=new Ge,ku=new Os;class bi{constructor(t=0,e=0,n=0,s=bi.DEFAULT_ORDER){this.isEuler=!0,this._x=t,this._y=e,this._z=n,this._order=s}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get order(){return this._order}set order(t){this._order=t,this._onChangeCallback()}set(t,e,n,s=this._order){return this._x=t,this._y=e,this._z=n,this._order=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._order)}copy(t){return this._x=t._x,this._y=t._y,this._z=t._z,this._order=t._order,this._onChangeCallback(),this}setFromRotationMatrix(t,e=this._order,n=!0){const s=t.elements,r=s[0],o=s[4],a=s[8],l=s[1],c=s[5],u=s[9],f=s[2],h=s[6],_=s[10];switch(e){case"XYZ":this._y=Math.asin(Rn(a,-1,1)),Math.abs(a)<.9999999?(this._x=Math.atan2(-u,_),this._z=Math.atan2(-o,r)):(this._x=Math.atan2(h,c),this._z=0);break;case"YXZ":this._x=Math.asin(-Rn(u,-1,1)),Math.abs(u)<.9999999?(this._y=Math.atan2(a,_),this._z=Math.atan2(l,c)):(this._y=Math.atan2(-f,r),this._z=0);break;case"ZXY":this._x=Math.asin(Rn(h,-1,1)),Math.abs(h)<.9999999?(this._y=Math.atan2(-f,_),this._z=Math.atan2(-o,c)):(this._y=0,this._z=Math.atan2(l,r));break;case"ZYX":this._y=Math.asin(-Rn(f,-1,1)),Math.abs(f)<.9999999?(this._x=Math.atan2(h,_),this._z=Math.atan2(l,r)):(this._x=0,this._z=Math.atan2(-o,c));break;case"YZX":this._z=Math.asin(Rn(l,-1,1)),Math.abs(l)<.9999999?(this._x=Math.atan2(-u,c),this._y=Math.atan2(-f,r)):(this._x=0,this._y=Math.atan2(a,_));break;case"XZY":this._z=Math.asin(-Rn(o,-1,1)),Math.abs(o)<.9999999?(this._x=Math.atan2(h,c),this._y=Math.atan2(a,r)):(this._x=Math.atan2(-u,_),this._y=0);break;default:console.warn("THREE.Euler: .setFromRotationMatrix() encountered an unknown order: "+e)}return this._order=e,n===!0&&this._onChangeCallback(),this}setFromQuaternion(t,e,n){return Nu.makeRotationFromQuaternion(t),this.setFromRotationMatrix(Nu,e,n)}setFromVector3(t,e=this._order){return this.set(t.x,t.y,t.z,e)}reorder(t){return ku.setFromEuler(this),this.setFromQuaternion(ku,t)}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._order===this._order}fromArray(t){return this._x=t[0],this._y=t[1],this._z=t[2],t[3]!==void 0&&(this._order=t[3]),this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._order,t}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._order}}bi.DEFAULT_ORDER="XYZ";class Qd{constructor(){this.mask=1}set(t){this.mask=(1<<t|0)>>>0}enable(t){this.mask|=1<<t|0}enableAll(){this.mask=-1}toggle(t){this.mask^=1<<t|0}disable(t){this.mask&=~(1<<t|0)}disableAll(){this.mask=0}test(t){return(this.mask&t.mask)!==0}isEnabled(t){return(this.mask&(1<<t|0))!==0}}let R_=0;const Ou=new $,or=new Os,Di=new Ge,Xo=new $,so=new $,C_=new $,P_=new Os,Fu=new $(1,0,0),Bu=new $(0,1,0),zu=new $(0,0,1),Hu={type:"added"},L_={type:"removed"},ar={type:"childadded",child:null},Rl={type:"childremoved",child:null};class fn extends Bs{constructor(){super(),this.isObject3D=!0,Object.defineProperty(this,"id",{value:R_++}),this.uuid=bo(),this.name="",this.type="Object3D",this.parent=null,this.children=[],this.up=fn.DEFAULT_UP.clone();const t=new $,e=new bi,n=new Os,s=new $(1,1,1);function r(){n.setFromEuler(e,!1)}function o(){e.setFromQuaternion(n,void 0,!1)}e._onChange(r),n._onChange(o),Object.defineProperties(this,{position:{configurable:!0,enumerable:!0,value:t},rotation:{configurable:!0,enumerable:!0,value:e},quaternion:{configurable:!0,enumerable:!0,value:n},scale:{configurable:!0,enumerable:!0,value:s},modelViewMatrix:{value:new Ge},normalMatrix:{value:new ae}}),this.matrix=new Ge,this.matrixWorld=new Ge,this.matrixAutoUpdate=fn.DEFAULT_MATRIX_AUTO_UPDATE,this.matrixWorldAutoUpdate=fn.DEFAULT_MATRIX_WORLD_AUTO_UPDATE,this.matrixWorldNeedsUpdate=!1,this.layers=new Qd,this.visible=!0,this.castShadow=!1,this.receiveShadow=!1,this.frustumCulled=!0,this.renderOrder=0,this.animations=[],this.userData={}}onBeforeShadow(){}onAfterShadow(){}onBeforeRender(){}onAfterRender(){}applyMatrix4(t){this.matrixAutoUpdate&&this.updateMatrix(),this.matrix.premultiply(t),this.matrix.decompose(this.position,this.quaternion,this.scale)}applyQuaternion(t){return this.quaternion.premultiply(t),this}setRotationFromAxisAngle(t,e){this.quaternion.setFromAxisAngle(t,e)}setRotationFromEuler(t){this.quaternion.setFromEuler(t,!0)}setRotationFromMatrix(t){this.quaternion.setFromRotationMatrix(t)}setRotationFromQuaternion(t){this.quaternion.copy(t)}rotateOnAxis(t,e){return or.setFromAxisAngle(t,e),this.quaternion.multiply(or),this}rotateOnWorldAxis(t,e){return or.setFromAxisAngle(t,e),this.quaternion.premultiply(or),this}rotateX(t){return this.rotateOnAxis(Fu,t)}rotateY(t){return this.rotateOnAxis(Bu,t)}rotateZ(t){return this.rotateOnAxis(zu,t)}translateOnAxis(t,e){return Ou.copy(t).applyQuaternion(this.quaternion),this.position.add(Ou.multiplyScalar(e)),this}translateX(t){return this.translateOnAxis(Fu,t)}translateY(t){return this.translateOnAxis(Bu,t)}translateZ(t){return this.translateOnAxis(zu,t)}localToWorld(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(this.matrixWorld)}worldToLocal(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(Di.copy(this.matrixWorld).invert())}lookAt(t,e,n){t.isVector3?Xo.copy(t):Xo.set(t,e,n);const s=this.parent;this.updateWorldMatrix(!0,!1),so.setFromMatrixPosition(this.matrixWorld),this.isCamera||this.isLight?Di.lookAt(so,Xo,this.up):Di.lookAt(Xo,so,this.up),this.quaternion.setFromRotationMatrix(Di),s&&(Di.extractRotation(s.matrixWorld),or.setFromRotationMatrix(Di),this.quaternion.premultiply(or.invert()))}add(t){if(arguments.length>1){for(let e=0;e<arguments.length;e++)this.add(arguments[e]);return this}return t===this?(console.error("THREE.Object3D.add: object can't be added as a child of itself.",t),this):(t&&t.isObject3D?(t.removeFromParent(),t.parent=this,this.children.push(t),t.dispatchEvent(Hu),ar.child=t,this.dispatchEvent(ar),ar.child=null):console.error("THREE.Object3D.add: object not an instance of THREE.Object3D.",t),this)}remove(t){if(arguments.length>1){for(let n=0;n<arguments.length;n++)this.remove(arguments[n]);return this}const e=this.children.indexOf(t);return e!==-1&&(t.parent=null,this.children.splice(e,1),t.dispatchEvent(L_),Rl.child=t,this.dispatchEvent(Rl),Rl.child=null),this}removeFromParent(){const t=this.parent;return t!==null&&t.remove(this),this}clear(){return this.remove(...this.children)}attach(t){return this.updateWorldMatrix(!0,!1),Di.copy(this.matrixWorld).invert(),t.parent!==null&&(t.parent.updateWorldMatrix(!0,!1),Di.multiply(t.parent.matrixWorld)),t.applyMatrix4(Di),t.removeFromParent(),t.parent=this,this.children.push(t),t.updateWorldMatrix(!1,!0),t.dispatchEvent(Hu),ar.child=t,this.dispatchEvent(ar),ar.child=null,this}getObjectById(t){return this.getObjectByProperty("id",t)}getObjectByName(t){return this.getObjectByProperty("name",t)}getObjectByProperty(t,e){if(this[t]===e)return this;for(let n=0,s=this.children.length;n<s;n++){const o=this.children[n].getObjectByProperty(t,e);if(o!==void 0)return o}}getObjectsByProperty(t,e,n=[]){this[t]===e&&n.push(this);const s=this.children;for(let r=0,o=s.length;r<o;r++)s[r].getObjectsByProperty(t,e,n);return n}getWorldPosition(t){return this.updateWorldMatrix(!0,!1),t.setFromMatrixPosition(this.matrixWorld)}getWorldQuaternion(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(so,t,C_),t}getWorldScale(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(so,P_,t),t}getWorldDirection(t){this.updateWorldMatrix(!0,!1);const e=this.matrixWorld.elements;return t.set(e[8],e[9],e[10]).normalize()}raycast(){}traverse(t){t(this);const e=this.children;for(let n=0,s=e.length;n<s;n++)e[n].traverse(t)}traverseVisible(t){if(this.visible===!1)return;t(this);const e=this.children;for(let n=0,s=e.length;n<s;n++)e[n].traverseVisible(t)}traverseAncestors(t){const e=this.parent;e!==null&&(t(e),e.traverseAncestors(t))}updateMatrix(){this.matrix.compose(this.position,this.quaternion,this.scale),this.matrixWorldNeedsUpdate=!0}updateMatrixWorld(t){this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||t)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,t=!0);const e=this.children;for(let n=0,s=e.length;n<s;n++)e[n].updateMatrixWorld(t)}updateWorldMatrix(t,e){const n=this.parent;if(t===!0&&n!==null&&n.updateWorldMatrix(!0,!1),this.matrixAutoUpdate&&this.updateMatrix(),this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),e===!0){const s=this.children;for(let r=0,o=s.length;r<o;r++)s[r].updateWorldMatrix(!1,!0)}}toJSON(t){const e=t===void 0||typeof t=="string",n={};e&&(t={geometries:{},materials:{},textures:{},images:{},shapes:{},skeletons:{},animations:{},nodes:{}},n.metadata={version:4.6,type:"Object",generator:"Object3D.toJSON"});const s={};s.uuid=this.uuid,s.type=this.type,this.name!==""&&(s.name=this.name),this.castShadow===!0&&(s.castShadow=!0),this.receiveShadow===!0&&(s.receiveShadow=!0),this.visible===!1&&(s.visible=!1),this.frustumCulled===!1&&(s.frustumCulled=!1),this.renderOrder!==0&&(s.renderOrder=this.renderOrder),Object.keys(this.userData).length>0&&(s.userData=this.userData),s.layers=this.layers.mask,s.matrix=this.matrix.toArray(),s.up=this.up.toArray(),this.matrixAutoUpdate===!1&&(s.matrixAutoUpdate=!1),this.isInstancedMesh&&(s.type="InstancedMesh",s.count=this.count,s.instanceMatrix=this.instanceMatrix.toJSON(),this.instanceColor!==null&&(s.instanceColor=this.instanceColor.toJSON())),this.isBatchedMesh&&(s.type="BatchedMesh",s.perObjectFrustumCulled=this.perObjectFrustumCulled,s.sortObjects=this.sortObjects,s.drawRanges=this._drawRanges,s.reservedRanges=this._reservedRanges,s.visibility=this._visibility,s.active=this._active,s.bounds=this._bounds.map(a=>({boxInitialized:a.boxInitialized,boxMin:a.box.min.toArray(),boxMax:a.box.max.toArray(),sphereInitialized:a.sphereInitialized,sphereRadius:a.sphere.radius,sphereCenter:a.sphere.center.toArray()})),s.maxInstanceCount=this._maxInstanceCount,s.maxVertexCount=this._maxVertexCount,s.maxIndexCount=this._maxIndexCount,s.geometryInitialized=this._geometryInitialized,s.geometryCount=this._geometryCount,s.matricesTexture=this._matricesTexture.toJSON(t),this._colorsTexture!==null&&(s.colorsTexture=this._colorsTexture.toJSON(t)),this.boundingSphere!==null&&(s.boundingSphere={center:s.boundingSphere.center.toArray(),radius:s.boundingSphere.radius}),this.boundingBox!==null&&(s.boundingBox={min:s.boundingBox.min.toArray(),max:s.boundingBox.max.toArray()}));function r(a,l){return a[l.uuid]===void 0&&(a[l.uuid]=l.toJSON(t)),l.uuid}if(this.isScene)this.background&&(this.background.isColor?s.background=this.background.toJSON():this.background.isTexture&&(s.background=this.background.toJSON(t).uuid)),this.environment&&this.environment.isTexture&&this.environment.isRenderTargetTexture!==!0&&(s.environment=this.environment.toJSON(t).uuid);else if(this.isMesh||this.isLine||this.isPoints){s.geometry=r(t.geometries,this.geometry);const a=this.geometry.parameters;if(a!==void 0&&a.shapes!==void 0){const l=a.shapes;if(Array.isArray(l))for(let c=0,u=l.length;c<u;c++){const f=l[c];r(t.shapes,f)}else r(t.shapes,l)}}if(this.isSkinnedMesh&&(s.bindMode=this.bindMode,s.bindMatrix=this.bindMatrix.toArray(),this.skeleton!==void 0&&(r(t.skeletons,this.skeleton),s.skeleton=this.skeleton.uuid)),this.material!==void 0)if(Array.isArray(this.material)){const a=[];for(let l=0,c=this.material.length;l<c;l++)a.push(r(t.materials,this.material[l]));s.material=a}else s.material=r(t.materials,this.material);if(this.children.length>0){s.children=[];for(let a=0;a<this.children.length;a++)s.children.push(this.children[a].toJSON(t).object)}if(this.animations.length>0){s.animations=[];for(let a=0;a<this.animations.length;a++){const l=this.animations[a];s.animations.push(r(t.animations,l))}}if(e){const a=o(t.geometries),l=o(t.materials),c=o(t.textures),u=o(t.images),f=o(t.shapes),h=o(t.skeletons),_=o(t.animations),x=o(t.nodes);a.length>0&&(n.geometries=a),l.length>0&&(n.materials=l),c.length>0&&(n.textures=c),u.length>0&&(n.images=u),f.length>0&&(n.shapes=f),h.length>0&&(n.skeletons=h),_.length>0&&(n.animations=_),x.length>0&&(n.nodes=x)}return n.object=s,n;function o(a){const l=[];for(const c in a){const u=a[c];delete u.metadata,l.push(u)}return l}}clone(t){return new this.constructor().copy(this,t)}copy(t,e=!0){if(this.name=t.name,this.up.copy(t.up),this.position.copy(t.position),this.rotation.order=t.rotation.order,this.quaternion.copy(t.quaternion),this.scale.copy(t.scale),this.matrix.copy(t.matrix),this.matrixWorld.copy(t.matrixWorld),this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrixWorldAutoUpdate=t.matrixWorldAutoUpdate,this.matrixWorldNeedsUpdate=t.matrixWorldNeedsUpdate,this.layers.mask=t.layers.mask,this.visible=t.visible,this.castShadow=t.castShadow,this.receiveShadow=t.receiveShadow,this.frustumCulled=t.frustumCulled,this.renderOrder=t.renderOrder,this.animations=t.animations.slice(),this.userData=JSON.parse(JSON.stringify(t.userData)),e===!0)for(let n=0;n<t.children.length;n++){const s=t.children[n];this.add(s.clone())}return this}}fn.DEFAULT_UP=new $(0,1,0);fn.DEFAULT_MATRIX_AUTO_UPDATE=!0;fn.DEFAULT_MATRIX_WORLD_AUTO_UPDATE=!0;const ai=new $,Ii=new $,Cl=new $,Ui=new $,lr=new $,cr=new $,Gu=new $,Pl=new $,Ll=new $,Dl=new $,Il=new Ye,Ul=new Ye,Nl=new Ye;class Zn{constructor(t=new $,e=new $,n=new $){this.a=t,this.b=e,this.c=n}static getNormal(t,e,n,s){s.subVectors(n,e),ai.subVectors(t,e),s.cross(ai);const r=s.lengthSq();return r>0?s.multiplyScalar(1/Math.sqrt(r)):s.set(0,0,0)}static getBarycoord(t,e,n,s,r){ai.subVectors(s,e),Ii.subVectors(n,e),Cl.subVectors(t,e);const o=ai.dot(ai),a=ai.dot(Ii),l=ai.dot(Cl),c=Ii.dot(Ii),u=Ii.dot(Cl),f=o*c-a*a;if(f===0)return r.set(0,0,0),null;const h=1/f,_=(c*l-a*u)*h,x=(o*u-a*l)*h;return r.set(1-_-x,x,_)}static containsPoint(t,e,n,s){return this.getBarycoord(t,e,n,s,Ui)===null?!1:Ui.x>=0&&Ui.y>=0&&Ui.x+Ui.y<=1}static getInterpolation(t,e,n,s,r,o,a,l){return this.getBarycoord(t,e,n,s,Ui)===null?(l.x=0,l.y=0,"z"in l&&(l.z=0),"w"in l&&(l.w=0),null):(l.setScalar(0),l.addScaledVector(r,Ui.x),l.addScaledVector(o,Ui.y),l.addScaledVector(a,Ui.z),l)}static getInterpolatedAttribute(t,e,n,s,r,o){return Il.setScalar(0),Ul.setScalar(0),Nl.setScalar(0),Il.fromBufferAttribute(t,e),Ul.fromBufferAttribute(t,n),Nl.fromBufferAttribute(t,s),o.setScalar(0),o.addScaledVector(Il,r.x),o.addScaledVector(Ul,r.y),o.addScaledVector(Nl,r.z),o}static isFrontFacing(t,e,n,s){return ai.subVectors(n,e),Ii.subVectors(t,e),ai.cross(Ii).dot(s)<0}set(t,e,n){return this.a.copy(t),this.b.copy(e),this.c.copy(n),this}setFromPointsAndIndices(t,e,n,s){return this.a.copy(t[e]),this.b.copy(t[n]),this.c.copy(t[s]),this}setFromAttributeAndIndices(t,e,n,s){return this.a.fromBufferAttribute(t,e),this.b.fromBufferAttribute(t,n),this.c.fromBufferAttribute(t,s),this}clone(){return new this.constructor().copy(this)}copy(t){return this.a.copy(t.a),this.b.copy(t.b),this.c.copy(t.c),this}getArea(){return ai.subVectors(this.c,this.b),Ii.subVectors(this.a,this.b),ai.cross(Ii).length()*.5}getMidpoint(t){return t.addVectors(this.a,this.b).add(this.c).multiplyScalar(1/3)}getNormal(t){return Zn.getNormal(this.a,this.b,this.c,t)}getPlane(t){return t.setFromCoplanarPoints(this.a,this.b,this.c)}getBarycoord(t,e){return Zn.getBarycoord(t,this.a,this.b,this.c,e)}getInterpolation(t,e,n,s,r){return Zn.getInterpolation(t,this.a,this.b,this.c,e,n,s,r)}containsPoint(t){return Zn.containsPoint(t,this.a,this.b,this.c)}isFrontFacing(t){return Zn.isFrontFacing(this.a,this.b,this.c,t)}intersectsBox(t){return t.intersectsTriangle(this)}closestPointToPoint(t,e){const n=this.a,s=this.b,r=this.c;let o,a;lr.subVectors(s,n),cr.subVectors(r,n),Pl.subVectors(t,n);const l=lr.dot(Pl),c=cr.dot(Pl);if(l<=0&&c<=0)return e.copy(n);Ll.subVectors(t,s);const u=lr.dot(Ll),f=cr.dot(Ll);if(u>=0&&f<=u)return e.copy(s);const h=l*f-u*c;if(h<=0&&l>=0&&u<=0)return o=l/(l-u),e.copy(n).addScaledVector(lr,o);Dl.subVectors(t,r);const _=lr.dot(Dl),x=cr.dot(Dl);if(x>=0&&_<=x)return e.copy(r);const M=_*c-l*x;if(M<=0&&c>=0&&x<=0)return a=c/(c-x),e.copy(n).addScaledVector(cr,a);const p=u*x-_*f;if(p<=0&&f-u>=0&&_-x>=0)return Gu.subVectors(r,s),a=(f-u)/(f-u+(_-x)),e.copy(s).addScaledVector(Gu,a);const d=1/(p+M+h);return o=M*d,a=h*d,e.copy(n).addScaledVector(lr,o).addScaledVector(cr,a)}equals(t){return t.a.equals(this.a)&&t.b.equals(this.b)&&t.c.equals(this.c)}}const tp={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074},Zi={h:0,s:0,l:0},qo={h:0,s:0,l:0};function kl(i,t,e){return e<0&&(e+=1),e>1&&(e-=1),e<1/6?i+(t-i)*6*e:e<1/2?t:e<2/3?i+(t-i)*6*(2/3-e):i}class ee{constructor(t,e,n){return this.isColor=!0,this.r=1,this.g=1,this.b=1,this.set(t,e,n)}set(t,e,n){if(e===void 0&&n===void 0){const s=t;s&&s.isColor?this.copy(s):typeof s=="number"?this.setHex(s):typeof s=="string"&&this.setStyle(s)}else this.setRGB(t,e,n);return this}setScalar(t){return this.r=t,this.g=t,this.b=t,this}setHex(t,e=Mi){return t=Math.floor(t),this.r=(t>>16&255)/255,this.g=(t>>8&255)/255,this.b=(t&255)/255,ye.toWorkingColorSpace(this,e),this}setRGB(t,e,n,s=ye.workingColorSpace){return this.r=t,this.g=e,this.b=n,ye.toWorkingColorSpace(this,s),this}setHSL(t,e,n,s=ye.workingColorSpace){if(t=d_(t,1),e=Rn(e,0,1),n=Rn(n,0,1),e===0)this.r=this.g=this.b=n;else{const r=n<=.5?n*(1+e):n+e-n*e,o=2*n-r;this.r=kl(o,r,t+1/3),this.g=kl(o,r,t),this.b=kl(o,r,t-1/3)}return ye.toWorkingColorSpace(this,s),this}setStyle(t,e=Mi){function n(r){r!==void 0&&parseFloat(r)<1&&console.warn("THREE.Color: Alpha component of "+t+" will be ignored.")}let s;if(s=/^(\w+)\(([^\)]*)\)/.exec(t)){let r;const o=s[1],a=s[2];switch(o){case"rgb":case"rgba":if(r=/^\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*(?:,\s*(\d*\.?\d+)\s*)?$/.exec(a))return n(r[4]),this.setRGB(Math.min(255,parseInt(r[1],10))/255,Math.min(255,parseInt(r[2],10))/255,Math.min(255,parseInt(r[3],10))/255,e);if(r=/^\s*(\d+)\%\s*,\s*(\d+)\%\s*,\s*(\d+)\%\s*(?:,\s*(\d*\.?\d+)\s*)?$/.exec(a))return n(r[4]),this.setRGB(Math.min(100,parseInt(r[1],10))/100,Math.min(100,parseInt(r[2],10))/100,Math.min(100,parseInt(r[3],10))/100,e);break;case"hsl":case"hsla":if(r=/^\s*(\d*\.?\d+)\s*,\s*(\d*\.?\d+)\%\s*,\s*(\d*\.?\d+)\%\s*(?:,\s*(\d*\.?\d+)\s*)?$/.exec(a))return n(r[4]),this.setHSL(parseFloat(r[1])/360,parseFloat(r[2])/100,parseFloat(r[3])/100,e);break;default:console.warn("THREE.Color: Unknown color model "+t)}}else if(s=/^\#([A-Fa-f\d]+)$/.exec(t)){const r=s[1],o=r.length;if(o===3)return this.setRGB(parseInt(r.charAt(0),16)/15,parseInt(r.charAt(1),16)/15,parseInt(r.charAt(2),16)/15,e);if(o===6)return this.setHex(parseInt(r,16),e);console.warn("THREE.Color: Invalid hex color "+t)}else if(t&&t.length>0)return this.setColorName(t,e);return this}setColorName(t,e=Mi){const n=tp[t.toLowerCase()];return n!==void 0?this.setHex(n,e):console.warn("THREE.Color: Unknown color "+t),this}clone(){return new this.constructor(this.r,this.g,this.b)}copy(t){return this.r=t.r,this.g=t.g,this.b=t.b,this}copySRGBToLinear(t){return this.r=br(t.r),this.g=br(t.g),this.b=br(t.b),this}copyLinearToSRGB(t){return this.r=Ml(t.r),this.g=Ml(t.g),this.b=Ml(t.b),this}convertSRGBToLinear(){return this.copySRGBToLinear(this),this}convertLinearToSRGB(){return this.copyLinearToSRGB(this),this}getHex(t=Mi){return ye.fromWorkingColorSpace(xn.copy(this),t),Math.round(Rn(xn.r*255,0,255))*65536+Math.round(Rn(xn.g*255,0,255))*256+Math.round(Rn(xn.b*255,0,255))}getHexString(t=Mi){return("000000"+this.getHex(t).toString(16)).slice(-6)}getHSL(t,e=ye.workingColorSpace){ye.fromWorkingColorSpace(xn.copy(this),e);const n=xn.r,s=xn.g,r=xn.b,o=Math.max(n,s,r),a=Math.min(n,s,r);let l,c;const u=(a+o)/2;if(a===o)l=0,c=0;else{const f=o-a;switch(c=u<=.5?f/(o+a):f/(2-o-a),o){case n:l=(s-r)/f+(s<r?6:0);break;case s:l=(r-n)/f+2;break;case r:l=(n-s)/f+4;break}l/=6}return t.h=l,t.s=c,t.l=u,t}getRGB(t,e=ye.workingColorSpace){return ye.fromWorkingColorSpace(xn.copy(this),e),t.r=xn.r,t.g=xn.g,t.b=xn.b,t}getStyle(t=Mi){ye.fromWorkingColorSpace(xn.copy(this),t);const e=xn.r,n=xn.g,s=xn.b;return t!==Mi?`color(${t} ${e.toFixed(3)} ${n.toFixed(3)} ${s.toFixed(3)})`:`rgb(${Math.round(e*255)},${Math.round(n*255)},${Math.round(s*255)})`}offsetHSL(t,e,n){return this.getHSL(Zi),this.setHSL(Zi.h+t,Zi.s+e,Zi.l+n)}add(t){return this.r+=t.r,this.g+=t.g,this.b+=t.b,this}addColors(t,e){return this.r=t.r+e.r,this.g=t.g+e.g,this.b=t.b+e.b,this}addScalar(t){return this.r+=t,this.g+=t,this.b+=t,this}sub(t){return this.r=Math.max(0,this.r-t.r),this.g=Math.max(0,this.g-t.g),this.b=Math.max(0,this.b-t.b),this}multiply(t){return this.r*=t.r,this.g*=t.g,this.b*=t.b,this}multiplyScalar(t){return this.r*=t,this.g*=t,this.b*=t,this}lerp(t,e){return this.r+=(t.r-this.r)*e,this.g+=(t.g-this.g)*e,this.b+=(t.b-this.b)*e,this}lerpColors(t,e,n){return this.r=t.r+(e.r-t.r)*n,this.g=t.g+(e.g-t.g)*n,this.b=t.b+(e.b-t.b)*n,this}lerpHSL(t,e){this.getHSL(Zi),t.getHSL(qo);const n=vl(Zi.h,qo.h,e),s=vl(Zi.s,qo.s,e),r=vl(Zi.l,qo.l,e);return this.setHSL(n,s,r),this}setFromVector3(t){return this.r=t.x,this.g=t.y,this.b=t.z,this}applyMatrix3(t){const e=this.r,n=this.g,s=this.b,r=t.elements;return this.r=r[0]*e+r[3]*n+r[6]*s,this.g=r[1]*e+r[4]*n+r[7]*s,this.b=r[2]*e+r[5]*n+r[8]*s,this}equals(t){return t.r===this.r&&t.g===this.g&&t.b===this.b}fromArray(t,e=0){return this.r=t[e],this.g=t[e+1],this.b=t[e+2],this}toArray(t=[],e=0){return t[e]=this.r,t[e+1]=this.g,t[e+2]=this.b,t}fromBufferAttribute(t,e){return this.r=t.getX(e),this.g=t.getY(e),this.b=t.getZ(e),this}toJSON(){return this.getHex()}*[Symbol.iterator](){yield this.r,yield this.g,yield this.b}}const xn=new ee;ee.NAMES=tp;let D_=0;class Fr extends Bs{constructor(){super(),this.isMaterial=!0,Object.defineProperty(this,"id",{value:D_++}),this.uuid=bo(),this.name="",this.type="Material",this.blending=Er,this.side=cs,this.vertexColors=!1,this.opacity=1,this.transparent=!1,this.alphaHash=!1,this.blendSrc=dc,this.blendDst=pc,this.blendEquation=Ts,this.blendSrcAlpha=null,this.blendDstAlpha=null,this.blendEquationAlpha=null,this.blendColor=new ee(0,0,0),this.blendAlpha=0,this.depthFunc=Ar,this.depthTest=!0,this.depthWrite=!0,this.stencilWriteMask=255,this.stencilFunc=Ru,this.stencilRef=0,this.stencilFuncMask=255,this.stencilFail=tr,this.stencilZFail=tr,this.stencilZPass=tr,this.stencilWrite=!1,this.clippingPlanes=null,this.clipIntersection=!1,this.clipShadows=!1,this.shadowSide=null,this.colorWrite=!0,this.precision=null,this.polygonOffset=!1,this.polygonOffsetFactor=0,this.polygonOffsetUnits=0,this.dithering=!1,this.alphaToCoverage=!1,this.premultipliedAlpha=!1,this.forceSinglePass=!1,this.visible=!0,this.toneMapped=!0,this.userData={},this.version=0,this._alphaTest=0}get alphaTest(){return this._alphaTest}set alphaTest(t){this._alphaTest>0!=t>0&&this.version++,this._alphaTest=t}onBeforeRender(){}onBeforeCompile(){}customProgramCacheKey(){return this.onBeforeCompile.toString()}setValues(t){if(t!==void 0)for(const e in t){const n=t[e];if(n===void 0){console.warn(`THREE.Material: parameter '${e}' has value of undefined.`);continue}const s=this[e];if(s===void 0){console.warn(`THREE.Material: '${e}' is not a property of THREE.${this.type}.`);continue}s&&s.isColor?s.set(n):s&&s.isVector3&&n&&n.isVector3?s.copy(n):this[e]=n}}toJSON(t){const e=t===void 0||typeof t=="string";e&&(t={textures:{},images:{}});const n={metadata:{version:4.6,type:"Material",generator:"Material.toJSON"}};n.uuid=this.uuid,n.type=this.type,this.name!==""&&(n.name=this.name),this.color&&this.color.isColor&&(n.color=this.color.getHex()),this.roughness!==void 0&&(n.roughness=this.roughness),this.metalness!==void 0&&(n.metalness=this.metalness),this.sheen!==void 0&&(n.sheen=this.sheen),this.sheenColor&&this.sheenColor.isColor&&(n.sheenColor=this.sheenColor.getHex()),this.sheenRoughness!==void 0&&(n.sheenRoughness=this.sheenRoughness),this.emissive&&this.emissive.isColor&&(n.emissive=this.emissive.getHex()),this.emissiveIntensity!==void 0&&this.emissiveIntensity!==1&&(n.emissiveIntensity=this.emissiveIntensity),this.specular&&this.specular.isColor&&(n.specular=this.specular.getHex()),this.specularIntensity!==void 0&&(n.specularIntensity=this.specularIntensity),this.specularColor&&this.specularColor.isColor&&(n.specularColor=this.specularColor.getHex()),this.shininess!==void 0&&(n.shininess=this.shininess),this.clearcoat!==void 0&&(n.clearcoat=this.clearcoat),this.clearcoatRoughness!==void 0&&(n.clearcoatRoughness=this.clearcoatRoughness),this.clearcoatMap&&this.clearcoatMap.isTexture&&(n.clearcoatMap=this.clearcoatMap.toJSON(t).uuid),this.clearcoatRoughnessMap&&this.clearcoatRoughnessMap.isTexture&&(n.clearcoatRoughnessMap=this.clearcoatRoughnessMap.toJSON(t).uuid),this.clearcoatNormalMap&&this.clearcoatNormalMap.isTexture&&(n.clearcoatNormalMap=this.clearcoatNormalMap.toJSON(t).uuid,n.clearcoatNormalScale=this.clearcoatNormalScale.toArray()),this.dispersion!==void 0&&(n.dispersion=this.dispersion),this.iridescence!==void 0&&(n.iridescence=this.iridescence),this.iridescenceIOR!==void 0&&(n.iridescenceIOR=this.iridescenceIOR),this.iridescenceThicknessRange!==void 0&&(n.iridescenceThicknessRange=this.iridescenceThicknessRange),this.iridescenceMap&&this.iridescenceMap.isTexture&&(n.iridescenceMap=this.iridescenceMap.toJSON(t).uuid),this.iridescenceThicknessMap&&this.iridescenceThicknessMap.isTexture&&(n.iridescenceThicknessMap=this.iridescenceThicknessMap.toJSON(t).uuid),this.anisotropy!==void 0&&(n.anisotropy=this.anisotropy),this.anisotropyRotation!==void 0&&(n.anisotropyRotation=this.anisotropyRotation),this.anisotropyMap&&this.anisotropyMap.isTexture&&(n.anisotropyMap=this.anisotropyMap.toJSON(t).uuid),this.map&&this.map.isTexture&&(n.map=this.map.toJSON(t).uuid),this.matcap&&this.matcap.isTexture&&(n.matcap=this.matcap.toJSON(t).uuid),this.alphaMap&&this.alphaMap.isTexture&&(n.alphaMap=this.alphaMap.toJSON(t).uuid),this.lightMap&&this.lightMap.isTexture&&(n.lightMap=this.lightMap.toJSON(t).uuid,n.lightMapIntensity=this.lightMapIntensity),this.aoMap&&this.aoMap.isTexture&&(n.aoMap=this.aoMap.toJSON(t).uuid,n.aoMapIntensity=this.aoMapIntensity),this.bumpMap&&this.bumpMap.isTexture&&(n.bumpMap=this.bumpMap.toJSON(t).uuid,n.bumpScale=this.bumpScale),this.normalMap&&this.normalMap.isTexture&&(n.normalMap=this.normalMap.toJSON(t).uuid,n.normalMapType=this.normalMapType,n.normalScale=this.normalScale.toArray()),this.displacementMap&&this.displacementMap.isTexture&&(n.displacementMap=this.displacementMap.toJSON(t).uuid,n.displacementScale=this.displacementScale,n.displacementBias=this.displacementBias),this.roughnessMap&&this.roughnessMap.isTexture&&(n.roughnessMap=this.roughnessMap.toJSON(t).uuid),this.metalnessMap&&this.metalnessMap.isTexture&&(n.metalnessMap=this.metalnessMap.toJSON(t).uuid),this.emissiveMap&&this.emissiveMap.isTexture&&(n.emissiveMap=this.emissiveMap.toJSON(t).uuid),this.specularMap&&this.specularMap.isTexture&&(n.specularMap=this.specularMap.toJSON(t).uuid),this.specularIntensityMap&&this.specularIntensityMap.isTexture&&(n.specularIntensityMap=this.specularIntensityMap.toJSON(t).uuid),this.specularColorMap&&this.specularColorMap.isTexture&&(n.specularColorMap=this.specularColorMap.toJSON(t).uuid),this.envMap&&this.envMap.isTexture&&(n.envMap=this.envMap.toJSON(t).uuid,this.combine!==void 0&&(n.combine=this.combine)),this.envMapRotation!==void 0&&(n.envMapRotation=this.envMapRotation.toArray()),this.envMapIntensity!==void 0&&(n.envMapIntensity=this.envMapIntensity),this.reflectivity!==void 0&&(n.reflectivity=this.reflectivity),this.refractionRatio!==void 0&&(n.refractionRatio=this.refractionRatio),this.gradientMap&&this.gradientMap.isTexture&&(n.gradientMap=this.gradientMap.toJSON(t).uuid),this.transmission!==void 0&&(n.transmission=this.transmission),this.transmissionMap&&this.transmissionMap.isTexture&&(n.transmissionMap=this.transmissionMap.toJSON(t).uuid),this.thickness!==void 0&&(n.thickness=this.thickness),this.thicknessMap&&this.thicknessMap.isTexture&&(n.thicknessMap=this.thicknessMap.toJSON(t).uuid),this.attenuationDistance!==void 0&&this.attenuationDistance!==1/0&&(n.attenuationDistance=this.attenuationDistance),this.attenuationColor!==void 0&&(n.attenuationColor=this.attenuationColor.getHex()),this.size!==void 0&&(n.size=this.size),this.shadowSide!==null&&(n.shadowSide=this.shadowSide),this.sizeAttenuation!==void 0&&(n.sizeAttenuation=this.sizeAttenuation),this.blending!==Er&&(n.blending=this.blending),this.side!==cs&&(n.side=this.side),this.vertexColors===!0&&(n.vertexColors=!0),this.opacity<1&&(n.opacity=this.opacity),this.transparent===!0&&(n.transparent=!0),this.blendSrc!==dc&&(n.blendSrc=this.blendSrc),this.blendDst!==pc&&(n.blendDst=this.blendDst),this.blendEquation!==Ts&&(n.blendEquation=this.blendEquation),this.blendSrcAlpha!==null&&(n.blendSrcAlpha=this.blendSrcAlpha),this.blendDstAlpha!==null&&(n.blendDstAlpha=this.blendDstAlpha),this.blendEquationAlpha!==null&&(n.blendEquationAlpha=this.blendEquationAlpha),this.blendColor&&this.blendColor.isColor&&(n.blendColor=this.blendColor.getHex()),this.blendAlpha!==0&&(n.blendAlpha=this.blendAlpha),this.depthFunc!==Ar&&(n.depthFunc=this.depthFunc),this.depthTest===!1&&(n.depthTest=this.depthTest),this.depthWrite===!1&&(n.depthWrite=this.depthWrite),this.colorWrite===!1&&(n.colorWrite=this.colorWrite),this.stencilWriteMask!==255&&(n.stencilWriteMask=this.stencilWriteMask),this.stencilFunc!==Ru&&(n.stencilFunc=this.stencilFunc),this.stencilRef!==0&&(n.stencilRef=this.stencilRef),this.stencilFuncMask!==255&&(n.stencilFuncMask=this.stencilFuncMask),this.stencilFail!==tr&&(n.stencilFail=this.stencilFail),this.stencilZFail!==tr&&(n.stencilZFail=this.stencilZFail),this.stencilZPass!==tr&&(n.stencilZPass=this.stencilZPass),this.stencilWrite===!0&&(n.stencilWrite=this.stencilWrite),this.rotation!==void 0&&this.rotation!==0&&(n.rotation=this.rotation),this.polygonOffset===!0&&(n.polygonOffset=!0),this.polygonOffsetFactor!==0&&(n.polygonOffsetFactor=this.polygonOffsetFactor),this.polygonOffsetUnits!==0&&(n.polygonOffsetUnits=this.polygonOffsetUnits),this.linewidth!==void 0&&this.linewidth!==1&&(n.linewidth=this.linewidth),this.dashSize!==void 0&&(n.dashSize=this.dashSize),this.gapSize!==void 0&&(n.gapSize=this.gapSize),this.scale!==void 0&&(n.scale=this.scale),this.dithering===!0&&(n.dithering=!0),this.alphaTest>0&&(n.alphaTest=this.alphaTest),this.alphaHash===!0&&(n.alphaHash=!0),this.alphaToCoverage===!0&&(n.alphaToCoverage=!0),this.premultipliedAlpha===!0&&(n.premultipliedAlpha=!0),this.forceSinglePass===!0&&(n.forceSinglePass=!0),this.wireframe===!0&&(n.wireframe=!0),this.wireframeLinewidth>1&&(n.wireframeLinewidth=this.wireframeLinewidth),this.wireframeLinecap!=="round"&&(n.wireframeLinecap=this.wireframeLinecap),this.wireframeLinejoin!=="round"&&(n.wireframeLinejoin=this.wireframeLinejoin),this.flatShading===!0&&(n.flatShading=!0),this.visible===!1&&(n.visible=!1),this.toneMapped===!1&&(n.toneMapped=!1),this.fog===!1&&(n.fog=!1),Object.keys(this.userData).length>0&&(n.userData=this.userData);function s(r){const o=[];for(const a in r){const l=r[a];delete l.metadata,o.push(l)}return o}if(e){const r=s(t.textures),o=s(t.images);r.length>0&&(n.textures=r),o.length>0&&(n.images=o)}return n}clone(){return new this.constructor().copy(this)}copy(t){this.name=t.name,this.blending=t.blending,this.side=t.side,this.vertexColors=t.vertexColors,this.opacity=t.opacity,this.transparent=t.transparent,this.blendSrc=t.blendSrc,this.blendDst=t.blendDst,this.blendEquation=t.blendEquation,this.blendSrcAlpha=t.blendSrcAlpha,this.blendDstAlpha=t.blendDstAlpha,this.blendEquationAlpha=t.blendEquationAlpha,this.blendColor.copy(t.blendColor),this.blendAlpha=t.blendAlpha,this.depthFunc=t.depthFunc,this.depthTest=t.depthTest,this.depthWrite=t.depthWrite,this.stencilWriteMask=t.stencilWriteMask,this.stencilFunc=t.stencilFunc,this.stencilRef=t.stencilRef,this.stencilFuncMask=t.stencilFuncMask,this.stencilFail=t.stencilFail,this.stencilZFail=t.stencilZFail,this.stencilZPass=t.stencilZPass,this.stencilWrite=t.stencilWrite;const e=t.clippingPlanes;let n=null;if(e!==null){const s=e.length;n=new Array(s);for(let r=0;r!==s;++r)n[r]=e[r].clone()}return this.clippingPlanes=n,this.clipIntersection=t.clipIntersection,this.clipShadows=t.clipShadows,this.shadowSide=t.shadowSide,this.colorWrite=t.colorWrite,this.precision=t.precision,this.polygonOffset=t.polygonOffset,this.polygonOffsetFactor=t.polygonOffsetFactor,this.polygonOffsetUnits=t.polygonOffsetUnits,this.dithering=t.dithering,this.alphaTest=t.alphaTest,this.alphaHash=t.alphaHash,this.alphaToCoverage=t.alphaToCoverage,this.premultipliedAlpha=t.premultipliedAlpha,this.forceSinglePass=t.forceSinglePass,this.visible=t.visible,this.toneMapped=t.toneMapped,this.userData=JSON.parse(JSON.stringify(t.userData)),this}dispose(){this.dispatchEvent({type:"dispose"})}set needsUpdate(t){t===!0&&this.version++}onBuild(){console.warn("Material: onBuild() has been removed.")}}class Br extends Fr{constructor(t){super(),this.isMeshBasicMaterial=!0,this.type="MeshBasicMaterial",this.color=new ee(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new bi,this.combine=gh,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.combine=t.combine,this.reflectivity=t.reflectivity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.fog=t.fog,this}}const Ze=new $,Yo=new se;class ei{constructor(t,e,n=!1){if(Array.isArray(t))throw new TypeError("THREE.BufferAttribute: array should be a Typed Array.");this.isBufferAttribute=!0,this.name="",this.array=t,this.itemSize=e,this.count=t!==void 0?t.length/e:0,this.normalized=n,this.usage=Cu,this.updateRanges=[],this.gpuType=Oi,this.version=0}onUploadCallback(){}set needsUpdate(t){t===!0&&this.version++}setUsage(t){return this.usage=t,this}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}copy(t){return this.name=t.name,this.array=new t.array.constructor(t.array),this.itemSize=t.itemSize,this.count=t.count,this.normalized=t.normalized,this.usage=t.usage,this.gpuType=t.gpuType,this}copyAt(t,e,n){t*=this.itemSize,n*=e.itemSize;for(let s=0,r=this.itemSize;s<r;s++)this.array[t+s]=e.array[n+s];return this}copyArray(t){return this.array.set(t),this}applyMatrix3(t){if(this.itemSize===2)for(let e=0,n=this.count;e<n;e++)Yo.fromBufferAttribute(this,e),Yo.applyMatrix3(t),this.setXY(e,Yo.x,Yo.y);else if(this.itemSize===3)for(let e=0,n=this.count;e<n;e++)Ze.fromBufferAttribute(this,e),Ze.applyMatrix3(t),this.setXYZ(e,Ze.x,Ze.y,Ze.z);return this}applyMatrix4(t){for(let e=0,n=this.count;e<n;e++)Ze.fromBufferAttribute(this,e),Ze.applyMatrix4(t),this.setXYZ(e,Ze.x,Ze.y,Ze.z);return this}applyNormalMatrix(t){for(let e=0,n=this.count;e<n;e++)Ze.fromBufferAttribute(this,e),Ze.applyNormalMatrix(t),this.setXYZ(e,Ze.x,Ze.y,Ze.z);return this}transformDirection(t){for(let e=0,n=this.count;e<n;e++)Ze.fromBufferAttribute(this,e),Ze.transformDirection(t),this.setXYZ(e,Ze.x,Ze.y,Ze.z);return this}set(t,e=0){return this.array.set(t,e),this}getComponent(t,e){let n=this.array[t*this.itemSize+e];return this.normalized&&(n=to(n,this.array)),n}setComponent(t,e,n){return this.normalized&&(n=In(n,this.array)),this.array[t*this.itemSize+e]=n,this}getX(t){let e=this.array[t*this.itemSize];return this.normalized&&(e=to(e,this.array)),e}setX(t,e){return this.normalized&&(e=In(e,this.array)),this.array[t*this.itemSize]=e,this}getY(t){let e=this.array[t*this.itemSize+1];return this.normalized&&(e=to(e,this.array)),e}setY(t,e){return this.normalized&&(e=In(e,this.array)),this.array[t*this.itemSize+1]=e,this}getZ(t){let e=this.array[t*this.itemSize+2];return this.normalized&&(e=to(e,this.array)),e}setZ(t,e){return this.normalized&&(e=In(e,this.array)),this.array[t*this.itemSize+2]=e,this}getW(t){let e=this.array[t*this.itemSize+3];return this.normalized&&(e=to(e,this.array)),e}setW(t,e){return this.normalized&&(e=In(e,this.array)),this.array[t*this.itemSize+3]=e,this}setXY(t,e,n){return t*=this.itemSize,this.normalized&&(e=In(e,this.array),n=In(n,this.array)),this.array[t+0]=e,this.array[t+1]=n,this}setXYZ(t,e,n,s){return t*=this.itemSize,this.normalized&&(e=In(e,this.array),n=In(n,this.array),s=In(s,this.array)),this.array[t+0]=e,this.array[t+1]=n,this.array[t+2]=s,this}setXYZW(t,e,n,s,r){return t*=this.itemSize,this.normalized&&(e=In(e,this.array),n=In(n,this.array),s=In(s,this.array),r=In(r,this.array)),this.array[t+0]=e,this.array[t+1]=n,this.array[t+2]=s,this.array[t+3]=r,this}onUpload(t){return this.onUploadCallback=t,this}clone(){return new this.constructor(this.array,this.itemSize).copy(this)}toJSON(){const t={itemSize:this.itemSize,type:this.array.constructor.name,array:Array.from(this.array),normalized:this.normalized};return this.name!==""&&(t.name=this.name),this.usage!==Cu&&(t.usage=this.usage),t}}class ep extends ei{constructor(t,e,n){super(new Uint16Array(t),e,n)}}class np extends ei{constructor(t,e,n){super(new Uint32Array(t),e,n)}}class Be extends ei{constructor(t,e,n){super(new Float32Array(t),e,n)}}let I_=0;const Yn=new Ge,Ol=new fn,hr=new $,Bn=new To,ro=new To,un=new $;class Sn extends Bs{constructor(){super(),this.isBufferGeometry=!0,Object.defineProperty(this,"id",{value:I_++}),this.uuid=bo(),this.name="",this.type="BufferGeometry",this.index=null,this.attributes={},this.morphAttributes={},this.morphTargetsRelative=!1,this.groups=[],this.boundingBox=null,this.boundingSphere=null,this.drawRange={start:0,count:1/0},this.userData={}}getIndex(){return this.index}setIndex(t){return Array.isArray(t)?this.index=new($d(t)?np:ep)(t,1):this.index=t,this}getAttribute(t){return this.attributes[t]}setAttribute(t,e){return this.attributes[t]=e,this}deleteAttribute(t){return delete this.attributes[t],this}hasAttribute(t){return this.attributes[t]!==void 0}addGroup(t,e,n=0){this.groups.push({start:t,count:e,materialIndex:n})}clearGroups(){this.groups=[]}setDrawRange(t,e){this.drawRange.start=t,this.drawRange.count=e}applyMatrix4(t){const e=this.attributes.position;e!==void 0&&(e.applyMatrix4(t),e.needsUpdate=!0);const n=this.attributes.normal;if(n!==void 0){const r=new ae().getNormalMatrix(t);n.applyNormalMatrix(r),n.needsUpdate=!0}const s=this.attributes.tangent;return s!==void 0&&(s.transformDirection(t),s.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this}applyQuaternion(t){return Yn.makeRotationFromQuaternion(t),this.applyMatrix4(Yn),this}rotateX(t){return Yn.makeRotationX(t),this.applyMatrix4(Yn),this}rotateY(t){return Yn.makeRotationY(t),this.applyMatrix4(Yn),this}rotateZ(t){return Yn.makeRotationZ(t),this.applyMatrix4(Yn),this}translate(t,e,n){return Yn.makeTranslation(t,e,n),this.applyMatrix4(Yn),this}scale(t,e,n){return Yn.makeScale(t,e,n),this.applyMatrix4(Yn),this}lookAt(t){return Ol.lookAt(t),Ol.updateMatrix(),this.applyMatrix4(Ol.matrix),this}center(){return this.computeBoundingBox(),this.boundingBox.getCenter(hr).negate(),this.translate(hr.x,hr.y,hr.z),this}setFromPoints(t){const e=[];for(let n=0,s=t.length;n<s;n++){const r=t[n];e.push(r.x,r.y,r.z||0)}return this.setAttribute("position",new Be(e,3)),this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new To);const t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){console.error("THREE.BufferGeometry.computeBoundingBox(): GLBufferAttribute requires a manual bounding box.",this),this.boundingBox.set(new $(-1/0,-1/0,-1/0),new $(1/0,1/0,1/0));return}if(t!==void 0){if(this.boundingBox.setFromBufferAttribute(t),e)for(let n=0,s=e.length;n<s;n++){const r=e[n];Bn.setFromBufferAttribute(r),this.morphTargetsRelative?(un.addVectors(this.boundingBox.min,Bn.min),this.boundingBox.expandByPoint(un),un.addVectors(this.boundingBox.max,Bn.max),this.boundingBox.expandByPoint(un)):(this.boundingBox.expandByPoint(Bn.min),this.boundingBox.expandByPoint(Bn.max))}}else this.boundingBox.makeEmpty();(isNaN(this.boundingBox.min.x)||isNaN(this.boundingBox.min.y)||isNaN(this.boundingBox.min.z))&&console.error('THREE.BufferGeometry.computeBoundingBox(): Computed min/max have NaN values. The "position" attribute is likely to have NaN values.',this)}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new Va);const t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){console.error("THREE.BufferGeometry.computeBoundingSphere(): GLBufferAttribute requires a manual bounding sphere.",this),this.boundingSphere.set(new $,1/0);return}if(t){const n=this.boundingSphere.center;if(Bn.setFromBufferAttribute(t),e)for(let r=0,o=e.length;r<o;r++){const a=e[r];ro.setFromBufferAttribute(a),this.morphTargetsRelative?(un.addVectors(Bn.min,ro.min),Bn.expandByPoint(un),un.addVectors(Bn.max,ro.max),Bn.expandByPoint(un)):(Bn.expandByPoint(ro.min),Bn.expandByPoint(ro.max))}Bn.getCenter(n);let s=0;for(let r=0,o=t.count;r<o;r++)un.fromBufferAttribute(t,r),s=Math.max(s,n.distanceToSquared(un));if(e)for(let r=0,o=e.length;r<o;r++){const a=e[r],l=this.morphTargetsRelative;for(let c=0,u=a.count;c<u;c++)un.fromBufferAttribute(a,c),l&&(hr.fromBufferAttribute(t,c),un.add(hr)),s=Math.max(s,n.distanceToSquared(un))}this.boundingSphere.radius=Math.sqrt(s),isNaN(this.boundingSphere.radius)&&console.error('THREE.BufferGeometry.computeBoundingSphere(): Computed radius is NaN. The "position" attribute is likely to have NaN values.',this)}}computeTangents(){const t=this.index,e=this.attributes;if(t===null||e.position===void 0||e.normal===void 0||e.uv===void 0){console.error("THREE.BufferGeometry: .computeTangents() failed. Missing required attributes (index, position, normal or uv)");return}const n=e.position,s=e.normal,r=e.uv;this.hasAttribute("tangent")===!1&&this.setAttribute("tangent",new ei(new Float32Array(4*n.count),4));const o=this.getAttribute("tangent"),a=[],l=[];for(let P=0;P<n.count;P++)a[P]=new $,l[P]=new $;const c=new $,u=new $,f=new $,h=new se,_=new se,x=new se,M=new $,p=new $;function d(P,O,g){c.fromBufferAttribute(n,P),u.fromBufferAttribute(n,O),f.fromBufferAttribute(n,g),h.fromBufferAttribute(r,P),_.fromBufferAttribute(r,O),x.fromBufferAttribute(r,g),u.sub(c),f.sub(c),_.sub(h),x.sub(h);const m=1/(_.x*x.y-x.x*_.y);isFinite(m)&&(M.copy(u).multiplyScalar(x.y).addScaledVector(f,-_.y).multiplyScalar(m),p.copy(f).multiplyScalar(_.x).addScaledVector(u,-x.x).multiplyScalar(m),a[P].add(M),a[O].add(M),a[g].add(M),l[P].add(p),l[O].add(p),l[g].add(p))}let C=this.groups;C.length===0&&(C=[{start:0,count:t.count}]);for(let P=0,O=C.length;P<O;++P){const g=C[P],m=g.start,E=g.count;for(let N=m,F=m+E;N<F;N+=3)d(t.getX(N+0),t.getX(N+1),t.getX(N+2))}const b=new $,R=new $,D=new $,A=new $;function y(P){D.fromBufferAttribute(s,P),A.copy(D);const O=a[P];b.copy(O),b.sub(D.multiplyScalar(D.dot(O))).normalize(),R.crossVectors(A,O);const m=R.dot(l[P])<0?-1:1;o.setXYZW(P,b.x,b.y,b.z,m)}for(let P=0,O=C.length;P<O;++P){const g=C[P],m=g.start,E=g.count;for(let N=m,F=m+E;N<F;N+=3)y(t.getX(N+0)),y(t.getX(N+1)),y(t.getX(N+2))}}computeVertexNormals(){const t=this.index,e=this.getAttribute("position");if(e!==void 0){let n=this.getAttribute("normal");if(n===void 0)n=new ei(new Float32Array(e.count*3),3),this.setAttribute("normal",n);else for(let h=0,_=n.count;h<_;h++)n.setXYZ(h,0,0,0);const s=new $,r=new $,o=new $,a=new $,l=new $,c=new $,u=new $,f=new $;if(t)for(let h=0,_=t.count;h<_;h+=3){const x=t.getX(h+0),M=t.getX(h+1),p=t.getX(h+2);s.fromBufferAttribute(e,x),r.fromBufferAttribute(e,M),o.fromBufferAttribute(e,p),u.subVectors(o,r),f.subVectors(s,r),u.cross(f),a.fromBufferAttribute(n,x),l.fromBufferAttribute(n,M),c.fromBufferAttribute(n,p),a.add(u),l.add(u),c.add(u),n.setXYZ(x,a.x,a.y,a.z),n.setXYZ(M,l.x,l.y,l.z),n.setXYZ(p,c.x,c.y,c.z)}else for(let h=0,_=e.count;h<_;h+=3)s.fromBufferAttribute(e,h+0),r.fromBufferAttribute(e,h+1),o.fromBufferAttribute(e,h+2),u.subVectors(o,r),f.subVectors(s,r),u.cross(f),n.setXYZ(h+0,u.x,u.y,u.z),n.setXYZ(h+1,u.x,u.y,u.z),n.setXYZ(h+2,u.x,u.y,u.z);this.normalizeNormals(),n.needsUpdate=!0}}normalizeNormals(){const t=this.attributes.normal;for(let e=0,n=t.count;e<n;e++)un.fromBufferAttribute(t,e),un.normalize(),t.setXYZ(e,un.x,un.y,un.z)}toNonIndexed(){function t(a,l){const c=a.array,u=a.itemSize,f=a.normalized,h=new c.constructor(l.length*u);let _=0,x=0;for(let M=0,p=l.length;M<p;M++){a.isInterleavedBufferAttribute?_=l[M]*a.data.stride+a.offset:_=l[M]*u;for(let d=0;d<u;d++)h[x++]=c[_++]}return new ei(h,u,f)}if(this.index===null)return console.warn("THREE.BufferGeometry.toNonIndexed(): BufferGeometry is already non-indexed."),this;const e=new Sn,n=this.index.array,s=this.attributes;for(const a in s){const l=s[a],c=t(l,n);e.setAttribute(a,c)}const r=this.morphAttributes;for(const a in r){const l=[],c=r[a];for(let u=0,f=c.length;u<f;u++){const h=c[u],_=t(h,n);l.push(_)}e.morphAttributes[a]=l}e.morphTargetsRelative=this.morphTargetsRelative;const o=this.groups;for(let a=0,l=o.length;a<l;a++){const c=o[a];e.addGroup(c.start,c.count,c.materialIndex)}return e}toJSON(){const t={metadata:{version:4.6,type:"BufferGeometry",generator:"BufferGeometry.toJSON"}};if(t.uuid=this.uuid,t.type=this.type,this.name!==""&&(t.name=this.name),Object.keys(this.userData).length>0&&(t.userData=this.userData),this.parameters!==void 0){const l=this.parameters;for(const c in l)l[c]!==void 0&&(t[c]=l[c]);return t}t.data={attributes:{}};const e=this.index;e!==null&&(t.data.index={type:e.array.constructor.name,array:Array.prototype.slice.call(e.array)});const n=this.attributes;for(const l in n){const c=n[l];t.data.attributes[l]=c.toJSON(t.data)}const s={};let r=!1;for(const l in this.morphAttributes){const c=this.morphAttributes[l],u=[];for(let f=0,h=c.length;f<h;f++){const _=c[f];u.push(_.toJSON(t.data))}u.length>0&&(s[l]=u,r=!0)}r&&(t.data.morphAttributes=s,t.data.morphTargetsRelative=this.morphTargetsRelative);const o=this.groups;o.length>0&&(t.data.groups=JSON.parse(JSON.stringify(o)));const a=this.boundingSphere;return a!==null&&(t.data.boundingSphere={center:a.center.toArray(),radius:a.radius}),t}clone(){return new this.constructor().copy(this)}copy(t){this.index=null,this.attributes={},this.morphAttributes={},this.groups=[],this.boundingBox=null,this.boundingSphere=null;const e={};this.name=t.name;const n=t.index;n!==null&&this.setIndex(n.clone(e));const s=t.attributes;for(const c in s){const u=s[c];this.setAttribute(c,u.clone(e))}const r=t.morphAttributes;for(const c in r){const u=[],f=r[c];for(let h=0,_=f.length;h<_;h++)u.push(f[h].clone(e));this.morphAttributes[c]=u}this.morphTargetsRelative=t.morphTargetsRelative;const o=t.groups;for(let c=0,u=o.length;c<u;c++){const f=o[c];this.addGroup(f.start,f.count,f.materialIndex)}const a=t.boundingBox;a!==null&&(this.boundingBox=a.clone());const l=t.boundingSphere;return l!==null&&(this.boundingSphere=l.clone()),this.drawRange.start=t.drawRange.start,this.drawRange.count=t.drawRange.count,this.userData=t.userData,this}dispose(){this.dispatchEvent({type:"dispose"})}}const Vu=new Ge,xs=new wh,jo=new Va,Wu=new $,Ko=new $,$o=new $,Zo=new $,Fl=new $,Jo=new $,Xu=new $,Qo=new $;class sn extends fn{constructor(t=new Sn,e=new Br){super(),this.isMesh=!0,this.type="Mesh",this.geometry=t,this.material=e,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),t.morphTargetInfluences!==void 0&&(this.morphTargetInfluences=t.morphTargetInfluences.slice()),t.morphTargetDictionary!==void 0&&(this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary)),this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}updateMorphTargets(){const e=this.geometry.morphAttributes,n=Object.keys(e);if(n.length>0){const s=e[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){const a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}getVertexPosition(t,e){const n=this.geometry,s=n.attributes.position,r=n.morphAttributes.position,o=n.morphTargetsRelative;e.fromBufferAttribute(s,t);const a=this.morphTargetInfluences;if(r&&a){Jo.set(0,0,0);for(let l=0,c=r.length;l<c;l++){const u=a[l],f=r[l];u!==0&&(Fl.fromBufferAttribute(f,t),o?Jo.addScaledVector(Fl,u):Jo.addScaledVector(Fl.sub(e),u))}e.add(Jo)}return e}raycast(t,e){const n=this.geometry,s=this.material,r=this.matrixWorld;s!==void 0&&(n.boundingSphere===null&&n.computeBoundingSphere(),jo.copy(n.boundingSphere),jo.applyMatrix4(r),xs.copy(t.ray).recast(t.near),!(jo.containsPoint(xs.origin)===!1&&(xs.intersectSphere(jo,Wu)===null||xs.origin.distanceToSquared(Wu)>(t.far-t.near)**2))&&(Vu.copy(r).invert(),xs.copy(t.ray).applyMatrix4(Vu),!(n.boundingBox!==null&&xs.intersectsBox(n.boundingBox)===!1)&&this._computeIntersections(t,e,xs)))}_computeIntersections(t,e,n){let s;const r=this.geometry,o=this.material,a=r.index,l=r.attributes.position,c=r.attributes.uv,u=r.attributes.uv1,f=r.attributes.normal,h=r.groups,_=r.drawRange;if(a!==null)if(Array.isArray(o))for(let x=0,M=h.length;x<M;x++){const p=h[x],d=o[p.materialIndex],C=Math.max(p.start,_.start),b=Math.min(a.count,Math.min(p.start+p.count,_.start+_.count));for(let R=C,D=b;R<D;R+=3){const A=a.getX(R),y=a.getX(R+1),P=a.getX(R+2);s=ta(this,d,t,n,c,u,f,A,y,P),s&&(s.faceIndex=Math.floor(R/3),s.face.materialIndex=p.materialIndex,e.push(s))}}else{const x=Math.max(0,_.start),M=Math.min(a.count,_.start+_.count);for(let p=x,d=M;p<d;p+=3){const C=a.getX(p),b=a.getX(p+1),R=a.getX(p+2);s=ta(this,o,t,n,c,u,f,C,b,R),s&&(s.faceIndex=Math.floor(p/3),e.push(s))}}else if(l!==void 0)if(Array.isArray(o))for(let x=0,M=h.length;x<M;x++){const p=h[x],d=o[p.materialIndex],C=Math.max(p.start,_.start),b=Math.min(l.count,Math.min(p.start+p.count,_.start+_.count));for(let R=C,D=b;R<D;R+=3){const A=R,y=R+1,P=R+2;s=ta(this,d,t,n,c,u,f,A,y,P),s&&(s.faceIndex=Math.floor(R/3),s.face.materialIndex=p.materialIndex,e.push(s))}}else{const x=Math.max(0,_.start),M=Math.min(l.count,_.start+_.count);for(let p=x,d=M;p<d;p+=3){const C=p,b=p+1,R=p+2;s=ta(this,o,t,n,c,u,f,C,b,R),s&&(s.faceIndex=Math.floor(p/3),e.push(s))}}}}function U_(i,t,e,n,s,r,o,a){let l;if(t.side===Nn?l=n.intersectTriangle(o,r,s,!0,a):l=n.intersectTriangle(s,r,o,t.side===cs,a),l===null)return null;Qo.copy(a),Qo.applyMatrix4(i.matrixWorld);const c=e.ray.origin.distanceTo(Qo);return c<e.near||c>e.far?null:{distance:c,point:Qo.clone(),object:i}}function ta(i,t,e,n,s,r,o,a,l,c){i.getVertexPosition(a,Ko),i.getVertexPosition(l,$o),i.getVertexPosition(c,Zo);const u=U_(i,t,e,n,Ko,$o,Zo,Xu);if(u){const f=new $;Zn.getBarycoord(Xu,Ko,$o,Zo,f),s&&(u.uv=Zn.getInterpolatedAttribute(s,a,l,c,f,new se)),r&&(u.uv1=Zn.getInterpolatedAttribute(r,a,l,c,f,new se)),o&&(u.normal=Zn.getInterpolatedAttribute(o,a,l,c,f,new $),u.normal.dot(n.direction)>0&&u.normal.multiplyScalar(-1));const h={a,b:l,c,normal:new $,materialIndex:0};Zn.getNormal(Ko,$o,Zo,h.normal),u.face=h,u.barycoord=f}return u}class zr extends Sn{constructor(t=1,e=1,n=1,s=1,r=1,o=1){super(),this.type="BoxGeometry",this.parameters={width:t,height:e,depth:n,widthSegments:s,heightSegments:r,depthSegments:o};const a=this;s=Math.floor(s),r=Math.floor(r),o=Math.floor(o);const l=[],c=[],u=[],f=[];let h=0,_=0;x("z","y","x",-1,-1,n,e,t,o,r,0),x("z","y","x",1,-1,n,e,-t,o,r,1),x("x","z","y",1,1,t,n,e,s,o,2),x("x","z","y",1,-1,t,n,-e,s,o,3),x("x","y","z",1,-1,t,e,n,s,r,4),x("x","y","z",-1,-1,t,e,-n,s,r,5),this.setIndex(l),this.setAttribute("position",new Be(c,3)),this.setAttribute("normal",new Be(u,3)),this.setAttribute("uv",new Be(f,2));function x(M,p,d,C,b,R,D,A,y,P,O){const g=R/y,m=D/P,E=R/2,N=D/2,F=A/2,B=y+1,G=P+1;let K=0,Q=0;const dt=new $;for(let ct=0;ct<G;ct++){const gt=ct*m-N;for(let xt=0;xt<B;xt++){const Vt=xt*g-E;dt[M]=Vt*C,dt[p]=gt*b,dt[d]=F,c.push(dt.x,dt.y,dt.z),dt[M]=0,dt[p]=0,dt[d]=A>0?1:-1,u.push(dt.x,dt.y,dt.z),f.push(xt/y),f.push(1-ct/P),K+=1}}for(let ct=0;ct<P;ct++)for(let gt=0;gt<y;gt++){const xt=h+gt+B*ct,Vt=h+gt+B*(ct+1),rt=h+(gt+1)+B*(ct+1),pt=h+(gt+1)+B*ct;l.push(xt,Vt,pt),l.push(Vt,rt,pt),Q+=6}a.addGroup(_,Q,O),_+=Q,h+=K}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new zr(t.width,t.height,t.depth,t.widthSegments,t.heightSegments,t.depthSegments)}}function Dr(i){const t={};for(const e in i){t[e]={};for(const n in i[e]){const s=i[e][n];s&&(s.isColor||s.isMatrix3||s.isMatrix4||s.isVector2||s.isVector3||s.isVector4||s.isTexture||s.isQuaternion)?s.isRenderTargetTexture?(console.warn("UniformsUtils: Textures of render targets cannot be cloned via cloneUniforms() or mergeUniforms()."),t[e][n]=null):t[e][n]=s.clone():Array.isArray(s)?t[e][n]=s.slice():t[e][n]=s}}return t}function An(i){const t={};for(let e=0;e<i.length;e++){const n=Dr(i[e]);for(const s in n)t[s]=n[s]}return t}function N_(i){const t=[];for(let e=0;e<i.length;e++)t.push(i[e].clone());return t}function ip(i){const t=i.getRenderTarget();return t===null?i.outputColorSpace:t.isXRRenderTarget===!0?t.texture.colorSpace:ye.workingColorSpace}const k_={clone:Dr,merge:An};var O_=`void main() {
	gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
}`,F_=`void main() {
	gl_FragColor = vec4( 1.0, 0.0, 0.0, 1.0 );
}`;class hs extends Fr{constructor(t){super(),this.isShaderMaterial=!0,this.type="ShaderMaterial",this.defines={},this.uniforms={},this.uniformsGroups=[],this.vertexShader=O_,this.fragmentShader=F_,this.linewidth=1,this.wireframe=!1,this.wireframeLinewidth=1,this.fog=!1,this.lights=!1,this.clipping=!1,this.forceSinglePass=!0,this.extensions={clipCullDistance:!1,multiDraw:!1},this.defaultAttributeValues={color:[1,1,1],uv:[0,0],uv1:[0,0]},this.index0AttributeName=void 0,this.uniformsNeedUpdate=!1,this.glslVersion=null,t!==void 0&&this.setValues(t)}copy(t){return super.copy(t),this.fragmentShader=t.fragmentShader,this.vertexShader=t.vertexShader,this.uniforms=Dr(t.uniforms),this.uniformsGroups=N_(t.uniformsGroups),this.defines=Object.assign({},t.defines),this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.fog=t.fog,this.lights=t.lights,this.clipping=t.clipping,this.extensions=Object.assign({},t.extensions),this.glslVersion=t.glslVersion,this}toJSON(t){const e=super.toJSON(t);e.glslVersion=this.glslVersion,e.uniforms={};for(const s in this.uniforms){const o=this.uniforms[s].value;o&&o.isTexture?e.uniforms[s]={type:"t",value:o.toJSON(t).uuid}:o&&o.isColor?e.uniforms[s]={type:"c",value:o.getHex()}:o&&o.isVector2?e.uniforms[s]={type:"v2",value:o.toArray()}:o&&o.isVector3?e.uniforms[s]={type:"v3",value:o.toArray()}:o&&o.isVector4?e.uniforms[s]={type:"v4",value:o.toArray()}:o&&o.isMatrix3?e.uniforms[s]={type:"m3",value:o.toArray()}:o&&o.isMatrix4?e.uniforms[s]={type:"m4",value:o.toArray()}:e.uniforms[s]={value:o}}Object.keys(this.defines).length>0&&(e.defines=this.defines),e.vertexShader=this.vertexShader,e.fragmentShader=this.fragmentShader,e.lights=this.lights,e.clipping=this.clipping;const n={};for(const s in this.extensions)this.extensions[s]===!0&&(n[s]=!0);return Object.keys(n).length>0&&(e.extensions=n),e}}class sp extends fn{constructor(){super(),this.isCamera=!0,this.type="Camera",this.matrixWorldInverse=new Ge,this.projectionMatrix=new Ge,this.projectionMatrixInverse=new Ge,this.coordinateSystem=Fi}copy(t,e){return super.copy(t,e),this.matrixWorldInverse.copy(t.matrixWorldInverse),this.projectionMatrix.copy(t.projectionMatrix),this.projectionMatrixInverse.copy(t.projectionMatrixInverse),this.coordinateSystem=t.coordinateSystem,this}getWorldDirection(t){return super.getWorldDirection(t).negate()}updateMatrixWorld(t){super.updateMatrixWorld(t),this.matrixWorldInverse.copy(this.matrixWorld).invert()}updateWorldMatrix(t,e){super.updateWorldMatrix(t,e),this.matrixWorldInverse.copy(this.matrixWorld).invert()}clone(){return new this.constructor().copy(this)}}const Ji=new $,qu=new se,Yu=new se;class $n extends sp{constructor(t=50,e=1,n=.1,s=2e3){super(),this.isPerspectiveCamera=!0,this.type="PerspectiveCamera",this.fov=t,this.zoom=1,this.near=n,this.far=s,this.focus=10,this.aspect=e,this.view=null,this.filmGauge=35,this.filmOffset=0,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.fov=t.fov,this.zoom=t.zoom,this.near=t.near,this.far=t.far,this.focus=t.focus,this.aspect=t.aspect,this.view=t.view===null?null:Object.assign({},t.view),this.filmGauge=t.filmGauge,this.filmOffset=t.filmOffset,this}setFocalLength(t){const e=.5*this.getFilmHeight()/t;this.fov=Jc*2*Math.atan(e),this.updateProjectionMatrix()}getFocalLength(){const t=Math.tan(mo*.5*this.fov);return .5*this.getFilmHeight()/t}getEffectiveFOV(){return Jc*2*Math.atan(Math.tan(mo*.5*this.fov)/this.zoom)}getFilmWidth(){return this.filmGauge*Math.min(this.aspect,1)}getFilmHeight(){return this.filmGauge/Math.max(this.aspect,1)}getViewBounds(t,e,n){Ji.set(-1,-1,.5).applyMatrix4(this.projectionMatrixInverse),e.set(Ji.x,Ji.y).multiplyScalar(-t/Ji.z),Ji.set(1,1,.5).applyMatrix4(this.projectionMatrixInverse),n.set(Ji.x,Ji.y).multiplyScalar(-t/Ji.z)}getViewSize(t,e){return this.getViewBounds(t,qu,Yu),e.subVectors(Yu,qu)}setViewOffset(t,e,n,s,r,o){this.aspect=t/e,this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=n,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){const t=this.near;let e=t*Math.tan(mo*.5*this.fov)/this.zoom,n=2*e,s=this.aspect*n,r=-.5*s;const o=this.view;if(this.view!==null&&this.view.enabled){const l=o.fullWidth,c=o.fullHeight;r+=o.offsetX*s/l,e-=o.offsetY*n/c,s*=o.width/l,n*=o.height/c}const a=this.filmOffset;a!==0&&(r+=t*a/this.getFilmWidth()),this.projectionMatrix.makePerspective(r,r+s,e,e-n,t,this.far,this.coordinateSystem),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){const e=super.toJSON(t);return e.object.fov=this.fov,e.object.zoom=this.zoom,e.object.near=this.near,e.object.far=this.far,e.object.focus=this.focus,e.object.aspect=this.aspect,this.view!==null&&(e.object.view=Object.assign({},this.view)),e.object.filmGauge=this.filmGauge,e.object.filmOffset=this.filmOffset,e}}const ur=-90,fr=1;class B_ extends fn{constructor(t,e,n){super(),this.type="CubeCamera",this.renderTarget=n,this.coordinateSystem=null,this.activeMipmapLevel=0;const s=new $n(ur,fr,t,e);s.layers=this.layers,this.add(s);const r=new $n(ur,fr,t,e);r.layers=this.layers,this.add(r);const o=new $n(ur,fr,t,e);o.layers=this.layers,this.add(o);const a=new $n(ur,fr,t,e);a.layers=this.layers,this.add(a);const l=new $n(ur,fr,t,e);l.layers=this.layers,this.add(l);const c=new $n(ur,fr,t,e);c.layers=this.layers,this.add(c)}updateCoordinateSystem(){const t=this.coordinateSystem,e=this.children.concat(),[n,s,r,o,a,l]=e;for(const c of e)this.remove(c);if(t===Fi)n.up.set(0,1,0),n.lookAt(1,0,0),s.up.set(0,1,0),s.lookAt(-1,0,0),r.up.set(0,0,-1),r.lookAt(0,1,0),o.up.set(0,0,1),o.lookAt(0,-1,0),a.up.set(0,1,0),a.lookAt(0,0,1),l.up.set(0,1,0),l.lookAt(0,0,-1);else if(t===Ia)n.up.set(0,-1,0),n.lookAt(-1,0,0),s.up.set(0,-1,0),s.lookAt(1,0,0),r.up.set(0,0,1),r.lookAt(0,1,0),o.up.set(0,0,-1),o.lookAt(0,-1,0),a.up.set(0,-1,0),a.lookAt(0,0,1),l.up.set(0,-1,0),l.lookAt(0,0,-1);else throw new Error("THREE.CubeCamera.updateCoordinateSystem(): Invalid coordinate system: "+t);for(const c of e)this.add(c),c.updateMatrixWorld()}update(t,e){this.parent===null&&this.updateMatrixWorld();const{renderTarget:n,activeMipmapLevel:s}=this;this.coordinateSystem!==t.coordinateSystem&&(this.coordinateSystem=t.coordinateSystem,this.updateCoordinateSystem());const[r,o,a,l,c,u]=this.children,f=t.getRenderTarget(),h=t.getActiveCubeFace(),_=t.getActiveMipmapLevel(),x=t.xr.enabled;t.xr.enabled=!1;const M=n.texture.generateMipmaps;n.texture.generateMipmaps=!1,t.setRenderTarget(n,0,s),t.render(e,r),t.setRenderTarget(n,1,s),t.render(e,o),t.setRenderTarget(n,2,s),t.render(e,a),t.setRenderTarget(n,3,s),t.render(e,l),t.setRenderTarget(n,4,s),t.render(e,c),n.texture.generateMipmaps=M,t.setRenderTarget(n,5,s),t.render(e,u),t.setRenderTarget(f,h,_),t.xr.enabled=x,n.texture.needsPMREMUpdate=!0}}class rp extends kn{constructor(t,e,n,s,r,o,a,l,c,u){t=t!==void 0?t:[],e=e!==void 0?e:Rr,super(t,e,n,s,r,o,a,l,c,u),this.isCubeTexture=!0,this.flipY=!1}get images(){return this.image}set images(t){this.image=t}}class z_ extends ks{constructor(t=1,e={}){super(t,t,e),this.isWebGLCubeRenderTarget=!0;const n={width:t,height:t,depth:1},s=[n,n,n,n,n,n];this.texture=new rp(s,e.mapping,e.wrapS,e.wrapT,e.magFilter,e.minFilter,e.format,e.type,e.anisotropy,e.colorSpace),this.texture.isRenderTargetTexture=!0,this.texture.generateMipmaps=e.generateMipmaps!==void 0?e.generateMipmaps:!1,this.texture.minFilter=e.minFilter!==void 0?e.minFilter:hi}fromEquirectangularTexture(t,e){this.texture.type=e.type,this.texture.colorSpace=e.colorSpace,this.texture.generateMipmaps=e.generateMipmaps,this.texture.minFilter=e.minFilter,this.texture.magFilter=e.magFilter;const n={uniforms:{tEquirect:{value:null}},vertexShader:`

				varying vec3 vWorldDirection;

				vec3 transformDirection( in vec3 dir, in mat4 matrix ) {

					return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );

				}

				void main() {

					vWorldDirection = transformDirection( position, modelMatrix );

					#include <begin_vertex>
					#include <project_vertex>

				}
			`,fragmentShader:`

				uniform sampler2D tEquirect;

				varying vec3 vWorldDirection;

				#include <common>

				void main() {

					vec3 direction = normalize( vWorldDirection );

					vec2 sampleUV = equirectUv( direction );

					gl_FragColor = texture2D( tEquirect, sampleUV );

				}
			`},s=new zr(5,5,5),r=new hs({name:"CubemapFromEquirect",uniforms:Dr(n.uniforms),vertexShader:n.vertexShader,fragmentShader:n.fragmentShader,side:Nn,blending:os});r.uniforms.tEquirect.value=e;const o=new sn(s,r),a=e.minFilter;return e.minFilter===Ps&&(e.minFilter=hi),new B_(1,10,this).update(t,o),e.minFilter=a,o.geometry.dispose(),o.material.dispose(),this}clear(t,e,n,s){const r=t.getRenderTarget();for(let o=0;o<6;o++)t.setRenderTarget(this,o),t.clear(e,n,s);t.setRenderTarget(r)}}const Bl=new $,H_=new $,G_=new ae;class Qi{constructor(t=new $(1,0,0),e=0){this.isPlane=!0,this.normal=t,this.constant=e}set(t,e){return this.normal.copy(t),this.constant=e,this}setComponents(t,e,n,s){return this.normal.set(t,e,n),this.constant=s,this}setFromNormalAndCoplanarPoint(t,e){return this.normal.copy(t),this.constant=-e.dot(this.normal),this}setFromCoplanarPoints(t,e,n){const s=Bl.subVectors(n,e).cross(H_.subVectors(t,e)).normalize();return this.setFromNormalAndCoplanarPoint(s,t),this}copy(t){return this.normal.copy(t.normal),this.constant=t.constant,this}normalize(){const t=1/this.normal.length();return this.normal.multiplyScalar(t),this.constant*=t,this}negate(){return this.constant*=-1,this.normal.negate(),this}distanceToPoint(t){return this.normal.dot(t)+this.constant}distanceToSphere(t){return this.distanceToPoint(t.center)-t.radius}projectPoint(t,e){return e.copy(t).addScaledVector(this.normal,-this.distanceToPoint(t))}intersectLine(t,e){const n=t.delta(Bl),s=this.normal.dot(n);if(s===0)return this.distanceToPoint(t.start)===0?e.copy(t.start):null;const r=-(t.start.dot(this.normal)+this.constant)/s;return r<0||r>1?null:e.copy(t.start).addScaledVector(n,r)}intersectsLine(t){const e=this.distanceToPoint(t.start),n=this.distanceToPoint(t.end);return e<0&&n>0||n<0&&e>0}intersectsBox(t){return t.intersectsPlane(this)}intersectsSphere(t){return t.intersectsPlane(this)}coplanarPoint(t){return t.copy(this.normal).multiplyScalar(-this.constant)}applyMatrix4(t,e){const n=e||G_.getNormalMatrix(t),s=this.coplanarPoint(Bl).applyMatrix4(t),r=this.normal.applyMatrix3(n).normalize();return this.constant=-s.dot(r),this}translate(t){return this.constant-=t.dot(this.normal),this}equals(t){return t.normal.equals(this.normal)&&t.constant===this.constant}clone(){return new this.constructor().copy(this)}}const Ms=new Va,ea=new $;class bh{constructor(t=new Qi,e=new Qi,n=new Qi,s=new Qi,r=new Qi,o=new Qi){this.planes=[t,e,n,s,r,o]}set(t,e,n,s,r,o){const a=this.planes;return a[0].copy(t),a[1].copy(e),a[2].copy(n),a[3].copy(s),a[4].copy(r),a[5].copy(o),this}copy(t){const e=this.planes;for(let n=0;n<6;n++)e[n].copy(t.planes[n]);return this}setFromProjectionMatrix(t,e=Fi){const n=this.planes,s=t.elements,r=s[0],o=s[1],a=s[2],l=s[3],c=s[4],u=s[5],f=s[6],h=s[7],_=s[8],x=s[9],M=s[10],p=s[11],d=s[12],C=s[13],b=s[14],R=s[15];if(n[0].setComponents(l-r,h-c,p-_,R-d).normalize(),n[1].setComponents(l+r,h+c,p+_,R+d).normalize(),n[2].setComponents(l+o,h+u,p+x,R+C).normalize(),n[3].setComponents(l-o,h-u,p-x,R-C).normalize(),n[4].setComponents(l-a,h-f,p-M,R-b).normalize(),e===Fi)n[5].setComponents(l+a,h+f,p+M,R+b).normalize();else if(e===Ia)n[5].setComponents(a,f,M,b).normalize();else throw new Error("THREE.Frustum.setFromProjectionMatrix(): Invalid coordinate system: "+e);return this}intersectsObject(t){if(t.boundingSphere!==void 0)t.boundingSphere===null&&t.computeBoundingSphere(),Ms.copy(t.boundingSphere).applyMatrix4(t.matrixWorld);else{const e=t.geometry;e.boundingSphere===null&&e.computeBoundingSphere(),Ms.copy(e.boundingSphere).applyMatrix4(t.matrixWorld)}return this.intersectsSphere(Ms)}intersectsSprite(t){return Ms.center.set(0,0,0),Ms.radius=.7071067811865476,Ms.applyMatrix4(t.matrixWorld),this.intersectsSphere(Ms)}intersectsSphere(t){const e=this.planes,n=t.center,s=-t.radius;for(let r=0;r<6;r++)if(e[r].distanceToPoint(n)<s)return!1;return!0}intersectsBox(t){const e=this.planes;for(let n=0;n<6;n++){const s=e[n];if(ea.x=s.normal.x>0?t.max.x:t.min.x,ea.y=s.normal.y>0?t.max.y:t.min.y,ea.z=s.normal.z>0?t.max.z:t.min.z,s.distanceToPoint(ea)<0)return!1}return!0}containsPoint(t){const e=this.planes;for(let n=0;n<6;n++)if(e[n].distanceToPoint(t)<0)return!1;return!0}clone(){return new this.constructor().copy(this)}}function op(){let i=null,t=!1,e=null,n=null;function s(r,o){e(r,o),n=i.requestAnimationFrame(s)}return{start:function(){t!==!0&&e!==null&&(n=i.requestAnimationFrame(s),t=!0)},stop:function(){i.cancelAnimationFrame(n),t=!1},setAnimationLoop:function(r){e=r},setContext:function(r){i=r}}}function V_(i){const t=new WeakMap;function e(a,l){const c=a.array,u=a.usage,f=c.byteLength,h=i.createBuffer();i.bindBuffer(l,h),i.bufferData(l,c,u),a.onUploadCallback();let _;if(c instanceof Float32Array)_=i.FLOAT;else if(c instanceof Uint16Array)a.isFloat16BufferAttribute?_=i.HALF_FLOAT:_=i.UNSIGNED_SHORT;else if(c instanceof Int16Array)_=i.SHORT;else if(c instanceof Uint32Array)_=i.UNSIGNED_INT;else if(c instanceof Int32Array)_=i.INT;else if(c instanceof Int8Array)_=i.BYTE;else if(c instanceof Uint8Array)_=i.UNSIGNED_BYTE;else if(c instanceof Uint8ClampedArray)_=i.UNSIGNED_BYTE;else throw new Error("THREE.WebGLAttributes: Unsupported buffer data format: "+c);return{buffer:h,type:_,bytesPerElement:c.BYTES_PER_ELEMENT,version:a.version,size:f}}function n(a,l,c){const u=l.array,f=l.updateRanges;if(i.bindBuffer(c,a),f.length===0)i.bufferSubData(c,0,u);else{f.sort((_,x)=>_.start-x.start);let h=0;for(let _=1;_<f.length;_++){const x=f[h],M=f[_];M.start<=x.start+x.count+1?x.count=Math.max(x.count,M.start+M.count-x.start):(++h,f[h]=M)}f.length=h+1;for(let _=0,x=f.length;_<x;_++){const M=f[_];i.bufferSubData(c,M.start*u.BYTES_PER_ELEMENT,u,M.start,M.count)}l.clearUpdateRanges()}l.onUploadCallback()}function s(a){return a.isInterleavedBufferAttribute&&(a=a.data),t.get(a)}function r(a){a.isInterleavedBufferAttribute&&(a=a.data);const l=t.get(a);l&&(i.deleteBuffer(l.buffer),t.delete(a))}function o(a,l){if(a.isInterleavedBufferAttribute&&(a=a.data),a.isGLBufferAttribute){const u=t.get(a);(!u||u.version<a.version)&&t.set(a,{buffer:a.buffer,type:a.type,bytesPerElement:a.elementSize,version:a.version});return}const c=t.get(a);if(c===void 0)t.set(a,e(a,l));else if(c.version<a.version){if(c.size!==a.array.byteLength)throw new Error("THREE.WebGLAttributes: The size of the buffer attribute's array buffer does not match the original size. Resizing buffer attributes is not supported.");n(c.buffer,a,l),c.version=a.version}}return{get:s,remove:r,update:o}}class Wa extends Sn{constructor(t=1,e=1,n=1,s=1){super(),this.type="PlaneGeometry",this.parameters={width:t,height:e,widthSegments:n,heightSegments:s};const r=t/2,o=e/2,a=Math.floor(n),l=Math.floor(s),c=a+1,u=l+1,f=t/a,h=e/l,_=[],x=[],M=[],p=[];for(let d=0;d<u;d++){const C=d*h-o;for(let b=0;b<c;b++){const R=b*f-r;x.push(R,-C,0),M.push(0,0,1),p.push(b/a),p.push(1-d/l)}}for(let d=0;d<l;d++)for(let C=0;C<a;C++){const b=C+c*d,R=C+c*(d+1),D=C+1+c*(d+1),A=C+1+c*d;_.push(b,R,A),_.push(R,D,A)}this.setIndex(_),this.setAttribute("position",new Be(x,3)),this.setAttribute("normal",new Be(M,3)),this.setAttribute("uv",new Be(p,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new Wa(t.width,t.height,t.widthSegments,t.heightSegments)}}var W_=`#ifdef USE_ALPHAHASH
	if ( diffuseColor.a < getAlphaHashThreshold( vPosition ) ) discard;
#endif`,X_=`#ifdef USE_ALPHAHASH
	const float ALPHA_HASH_SCALE = 0.05;
	float hash2D( vec2 value ) {
		return fract( 1.0e4 * sin( 17.0 * value.x + 0.1 * value.y ) * ( 0.1 + abs( sin( 13.0 * value.y + value.x ) ) ) );
	}
	float hash3D( vec3 value ) {
		return hash2D( vec2( hash2D( value.xy ), value.z ) );
	}
	float getAlphaHashThreshold( vec3 position ) {
		float maxDeriv = max(
			length( dFdx( position.xyz ) ),
			length( dFdy( position.xyz ) )
		);
		float pixScale = 1.0 / ( ALPHA_HASH_SCALE * maxDeriv );
		vec2 pixScales = vec2(
			exp2( floor( log2( pixScale ) ) ),
			exp2( ceil( log2( pixScale ) ) )
		);
		vec2 alpha = vec2(
			hash3D( floor( pixScales.x * position.xyz ) ),
			hash3D( floor( pixScales.y * position.xyz ) )
		);
		float lerpFactor = fract( log2( pixScale ) );
		float x = ( 1.0 - lerpFactor ) * alpha.x + lerpFactor * alpha.y;
		float a = min( lerpFactor, 1.0 - lerpFactor );
		vec3 cases = vec3(
			x * x / ( 2.0 * a * ( 1.0 - a ) ),
			( x - 0.5 * a ) / ( 1.0 - a ),
			1.0 - ( ( 1.0 - x ) * ( 1.0 - x ) / ( 2.0 * a * ( 1.0 - a ) ) )
		);
		float threshold = ( x < ( 1.0 - a ) )
			? ( ( x < a ) ? cases.x : cases.y )
			: cases.z;
		return clamp( threshold , 1.0e-6, 1.0 );
	}
#endif`,q_=`#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, vAlphaMapUv ).g;
#endif`,Y_=`#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,j_=`#ifdef USE_ALPHATEST
	#ifdef ALPHA_TO_COVERAGE
	diffuseColor.a = smoothstep( alphaTest, alphaTest + fwidth( diffuseColor.a ), diffuseColor.a );
	if ( diffuseColor.a == 0.0 ) discard;
	#else
	if ( diffuseColor.a < alphaTest ) discard;
	#endif
#endif`,K_=`#ifdef USE_ALPHATEST
	uniform float alphaTest;
#endif`,$_=`#ifdef USE_AOMAP
	float ambientOcclusion = ( texture2D( aoMap, vAoMapUv ).r - 1.0 ) * aoMapIntensity + 1.0;
	reflectedLight.indirectDiffuse *= ambientOcclusion;
	#if defined( USE_CLEARCOAT ) 
		clearcoatSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_SHEEN ) 
		sheenSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_ENVMAP ) && defined( STANDARD )
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		reflectedLight.indirectSpecular *= computeSpecularOcclusion( dotNV, ambientOcclusion, material.roughness );
	#endif
#endif`,Z_=`#ifdef USE_AOMAP
	uniform sampler2D aoMap;
	uniform float aoMapIntensity;
#endif`,J_=`#ifdef USE_BATCHING
	#if ! defined( GL_ANGLE_multi_draw )
	#define gl_DrawID _gl_DrawID
	uniform int _gl_DrawID;
	#endif
	uniform highp sampler2D batchingTexture;
	uniform highp usampler2D batchingIdTexture;
	mat4 getBatchingMatrix( const in float i ) {
		int size = textureSize( batchingTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( batchingTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( batchingTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( batchingTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( batchingTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
	float getIndirectIndex( const in int i ) {
		int size = textureSize( batchingIdTexture, 0 ).x;
		int x = i % size;
		int y = i / size;
		return float( texelFetch( batchingIdTexture, ivec2( x, y ), 0 ).r );
	}
#endif
#ifdef USE_BATCHING_COLOR
	uniform sampler2D batchingColorTexture;
	vec3 getBatchingColor( const in float i ) {
		int size = textureSize( batchingColorTexture, 0 ).x;
		int j = int( i );
		int x = j % size;
		int y = j / size;
		return texelFetch( batchingColorTexture, ivec2( x, y ), 0 ).rgb;
	}
#endif`,Q_=`#ifdef USE_BATCHING
	mat4 batchingMatrix = getBatchingMatrix( getIndirectIndex( gl_DrawID ) );
#endif`,t0=`vec3 transformed = vec3( position );
#ifdef USE_ALPHAHASH
	vPosition = vec3( position );
#endif`,e0=`vec3 objectNormal = vec3( normal );
#ifdef USE_TANGENT
	vec3 objectTangent = vec3( tangent.xyz );
#endif`,n0=`float G_BlinnPhong_Implicit( ) {
	return 0.25;
}
float D_BlinnPhong( const in float shininess, const in float dotNH ) {
	return RECIPROCAL_PI * ( shininess * 0.5 + 1.0 ) * pow( dotNH, shininess );
}
vec3 BRDF_BlinnPhong( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 specularColor, const in float shininess ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( specularColor, 1.0, dotVH );
	float G = G_BlinnPhong_Implicit( );
	float D = D_BlinnPhong( shininess, dotNH );
	return F * ( G * D );
} // validated`,i0=`#ifdef USE_IRIDESCENCE
	const mat3 XYZ_TO_REC709 = mat3(
		 3.2404542, -0.9692660,  0.0556434,
		-1.5371385,  1.8760108, -0.2040259,
		-0.4985314,  0.0415560,  1.0572252
	);
	vec3 Fresnel0ToIor( vec3 fresnel0 ) {
		vec3 sqrtF0 = sqrt( fresnel0 );
		return ( vec3( 1.0 ) + sqrtF0 ) / ( vec3( 1.0 ) - sqrtF0 );
	}
	vec3 IorToFresnel0( vec3 transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - vec3( incidentIor ) ) / ( transmittedIor + vec3( incidentIor ) ) );
	}
	float IorToFresnel0( float transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - incidentIor ) / ( transmittedIor + incidentIor ));
	}
	vec3 evalSensitivity( float OPD, vec3 shift ) {
		float phase = 2.0 * PI * OPD * 1.0e-9;
		vec3 val = vec3( 5.4856e-13, 4.4201e-13, 5.2481e-13 );
		vec3 pos = vec3( 1.6810e+06, 1.7953e+06, 2.2084e+06 );
		vec3 var = vec3( 4.3278e+09, 9.3046e+09, 6.6121e+09 );
		vec3 xyz = val * sqrt( 2.0 * PI * var ) * cos( pos * phase + shift ) * exp( - pow2( phase ) * var );
		xyz.x += 9.7470e-14 * sqrt( 2.0 * PI * 4.5282e+09 ) * cos( 2.2399e+06 * phase + shift[ 0 ] ) * exp( - 4.5282e+09 * pow2( phase ) );
		xyz /= 1.0685e-7;
		vec3 rgb = XYZ_TO_REC709 * xyz;
		return rgb;
	}
	vec3 evalIridescence( float outsideIOR, float eta2, float cosTheta1, float thinFilmThickness, vec3 baseF0 ) {
		vec3 I;
		float iridescenceIOR = mix( outsideIOR, eta2, smoothstep( 0.0, 0.03, thinFilmThickness ) );
		float sinTheta2Sq = pow2( outsideIOR / iridescenceIOR ) * ( 1.0 - pow2( cosTheta1 ) );
		float cosTheta2Sq = 1.0 - sinTheta2Sq;
		if ( cosTheta2Sq < 0.0 ) {
			return vec3( 1.0 );
		}
		float cosTheta2 = sqrt( cosTheta2Sq );
		float R0 = IorToFresnel0( iridescenceIOR, outsideIOR );
		float R12 = F_Schlick( R0, 1.0, cosTheta1 );
		float T121 = 1.0 - R12;
		float phi12 = 0.0;
		if ( iridescenceIOR < outsideIOR ) phi12 = PI;
		float phi21 = PI - phi12;
		vec3 baseIOR = Fresnel0ToIor( clamp( baseF0, 0.0, 0.9999 ) );		vec3 R1 = IorToFresnel0( baseIOR, iridescenceIOR );
		vec3 R23 = F_Schlick( R1, 1.0, cosTheta2 );
		vec3 phi23 = vec3( 0.0 );
		if ( baseIOR[ 0 ] < iridescenceIOR ) phi23[ 0 ] = PI;
		if ( baseIOR[ 1 ] < iridescenceIOR ) phi23[ 1 ] = PI;
		if ( baseIOR[ 2 ] < iridescenceIOR ) phi23[ 2 ] = PI;
		float OPD = 2.0 * iridescenceIOR * thinFilmThickness * cosTheta2;
		vec3 phi = vec3( phi21 ) + phi23;
		vec3 R123 = clamp( R12 * R23, 1e-5, 0.9999 );
		vec3 r123 = sqrt( R123 );
		vec3 Rs = pow2( T121 ) * R23 / ( vec3( 1.0 ) - R123 );
		vec3 C0 = R12 + Rs;
		I = C0;
		vec3 Cm = Rs - T121;
		for ( int m = 1; m <= 2; ++ m ) {
			Cm *= r123;
			vec3 Sm = 2.0 * evalSensitivity( float( m ) * OPD, float( m ) * phi );
			I += Cm * Sm;
		}
		return max( I, vec3( 0.0 ) );
	}
#endif`,s0=`#ifdef USE_BUMPMAP
	uniform sampler2D bumpMap;
	uniform float bumpScale;
	vec2 dHdxy_fwd() {
		vec2 dSTdx = dFdx( vBumpMapUv );
		vec2 dSTdy = dFdy( vBumpMapUv );
		float Hll = bumpScale * texture2D( bumpMap, vBumpMapUv ).x;
		float dBx = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdx ).x - Hll;
		float dBy = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdy ).x - Hll;
		return vec2( dBx, dBy );
	}
	vec3 perturbNormalArb( vec3 surf_pos, vec3 surf_norm, vec2 dHdxy, float faceDirection ) {
		vec3 vSigmaX = normalize( dFdx( surf_pos.xyz ) );
		vec3 vSigmaY = normalize( dFdy( surf_pos.xyz ) );
		vec3 vN = surf_norm;
		vec3 R1 = cross( vSigmaY, vN );
		vec3 R2 = cross( vN, vSigmaX );
		float fDet = dot( vSigmaX, R1 ) * faceDirection;
		vec3 vGrad = sign( fDet ) * ( dHdxy.x * R1 + dHdxy.y * R2 );
		return normalize( abs( fDet ) * surf_norm - vGrad );
	}
#endif`,r0=`#if NUM_CLIPPING_PLANES > 0
	vec4 plane;
	#ifdef ALPHA_TO_COVERAGE
		float distanceToPlane, distanceGradient;
		float clipOpacity = 1.0;
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
			distanceGradient = fwidth( distanceToPlane ) / 2.0;
			clipOpacity *= smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			if ( clipOpacity == 0.0 ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			float unionClipOpacity = 1.0;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
				distanceGradient = fwidth( distanceToPlane ) / 2.0;
				unionClipOpacity *= 1.0 - smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			}
			#pragma unroll_loop_end
			clipOpacity *= 1.0 - unionClipOpacity;
		#endif
		diffuseColor.a *= clipOpacity;
		if ( diffuseColor.a == 0.0 ) discard;
	#else
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			if ( dot( vClipPosition, plane.xyz ) > plane.w ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			bool clipped = true;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				clipped = ( dot( vClipPosition, plane.xyz ) > plane.w ) && clipped;
			}
			#pragma unroll_loop_end
			if ( clipped ) discard;
		#endif
	#endif
#endif`,o0=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
	uniform vec4 clippingPlanes[ NUM_CLIPPING_PLANES ];
#endif`,a0=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
#endif`,l0=`#if NUM_CLIPPING_PLANES > 0
	vClipPosition = - mvPosition.xyz;
#endif`,c0=`#if defined( USE_COLOR_ALPHA )
	diffuseColor *= vColor;
#elif defined( USE_COLOR )
	diffuseColor.rgb *= vColor;
#endif`,h0=`#if defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#elif defined( USE_COLOR )
	varying vec3 vColor;
#endif`,u0=`#if defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#elif defined( USE_COLOR ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	varying vec3 vColor;
#endif`,f0=`#if defined( USE_COLOR_ALPHA )
	vColor = vec4( 1.0 );
#elif defined( USE_COLOR ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	vColor = vec3( 1.0 );
#endif
#ifdef USE_COLOR
	vColor *= color;
#endif
#ifdef USE_INSTANCING_COLOR
	vColor.xyz *= instanceColor.xyz;
#endif
#ifdef USE_BATCHING_COLOR
	vec3 batchingColor = getBatchingColor( getIndirectIndex( gl_DrawID ) );
	vColor.xyz *= batchingColor.xyz;
#endif`,d0=`#define PI 3.141592653589793
#define PI2 6.283185307179586
#define PI_HALF 1.5707963267948966
#define RECIPROCAL_PI 0.3183098861837907
#define RECIPROCAL_PI2 0.15915494309189535
#define EPSILON 1e-6
#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
#define whiteComplement( a ) ( 1.0 - saturate( a ) )
float pow2( const in float x ) { return x*x; }
vec3 pow2( const in vec3 x ) { return x*x; }
float pow3( const in float x ) { return x*x*x; }
float pow4( const in float x ) { float x2 = x*x; return x2*x2; }
float max3( const in vec3 v ) { return max( max( v.x, v.y ), v.z ); }
float average( const in vec3 v ) { return dot( v, vec3( 0.3333333 ) ); }
highp float rand( const in vec2 uv ) {
	const highp float a = 12.9898, b = 78.233, c = 43758.5453;
	highp float dt = dot( uv.xy, vec2( a,b ) ), sn = mod( dt, PI );
	return fract( sin( sn ) * c );
}
#ifdef HIGH_PRECISION
	float precisionSafeLength( vec3 v ) { return length( v ); }
#else
	float precisionSafeLength( vec3 v ) {
		float maxComponent = max3( abs( v ) );
		return length( v / maxComponent ) * maxComponent;
	}
#endif
struct IncidentLight {
	vec3 color;
	vec3 direction;
	bool visible;
};
struct ReflectedLight {
	vec3 directDiffuse;
	vec3 directSpecular;
	vec3 indirectDiffuse;
	vec3 indirectSpecular;
};
#ifdef USE_ALPHAHASH
	varying vec3 vPosition;
#endif
vec3 transformDirection( in vec3 dir, in mat4 matrix ) {
	return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );
}
vec3 inverseTransformDirection( in vec3 dir, in mat4 matrix ) {
	return normalize( ( vec4( dir, 0.0 ) * matrix ).xyz );
}
mat3 transposeMat3( const in mat3 m ) {
	mat3 tmp;
	tmp[ 0 ] = vec3( m[ 0 ].x, m[ 1 ].x, m[ 2 ].x );
	tmp[ 1 ] = vec3( m[ 0 ].y, m[ 1 ].y, m[ 2 ].y );
	tmp[ 2 ] = vec3( m[ 0 ].z, m[ 1 ].z, m[ 2 ].z );
	return tmp;
}
bool isPerspectiveMatrix( mat4 m ) {
	return m[ 2 ][ 3 ] == - 1.0;
}
vec2 equirectUv( in vec3 dir ) {
	float u = atan( dir.z, dir.x ) * RECIPROCAL_PI2 + 0.5;
	float v = asin( clamp( dir.y, - 1.0, 1.0 ) ) * RECIPROCAL_PI + 0.5;
	return vec2( u, v );
}
vec3 BRDF_Lambert( const in vec3 diffuseColor ) {
	return RECIPROCAL_PI * diffuseColor;
}
vec3 F_Schlick( const in vec3 f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
}
float F_Schlick( const in float f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
} // validated`,p0=`#ifdef ENVMAP_TYPE_CUBE_UV
	#define cubeUV_minMipLevel 4.0
	#define cubeUV_minTileSize 16.0
	float getFace( vec3 direction ) {
		vec3 absDirection = abs( direction );
		float face = - 1.0;
		if ( absDirection.x > absDirection.z ) {
			if ( absDirection.x > absDirection.y )
				face = direction.x > 0.0 ? 0.0 : 3.0;
			else
				face = direction.y > 0.0 ? 1.0 : 4.0;
		} else {
			if ( absDirection.z > absDirection.y )
				face = direction.z > 0.0 ? 2.0 : 5.0;
			else
				face = direction.y > 0.0 ? 1.0 : 4.0;
		}
		return face;
	}
	vec2 getUV( vec3 direction, float face ) {
		vec2 uv;
		if ( face == 0.0 ) {
			uv = vec2( direction.z, direction.y ) / abs( direction.x );
		} else if ( face == 1.0 ) {
			uv = vec2( - direction.x, - direction.z ) / abs( direction.y );
		} else if ( face == 2.0 ) {
			uv = vec2( - direction.x, direction.y ) / abs( direction.z );
		} else if ( face == 3.0 ) {
			uv = vec2( - direction.z, direction.y ) / abs( direction.x );
		} else if ( face == 4.0 ) {
			uv = vec2( - direction.x, direction.z ) / abs( direction.y );
		} else {
			uv = vec2( direction.x, direction.y ) / abs( direction.z );
		}
		return 0.5 * ( uv + 1.0 );
	}
	vec3 bilinearCubeUV( sampler2D envMap, vec3 direction, float mipInt ) {
		float face = getFace( direction );
		float filterInt = max( cubeUV_minMipLevel - mipInt, 0.0 );
		mipInt = max( mipInt, cubeUV_minMipLevel );
		float faceSize = exp2( mipInt );
		highp vec2 uv = getUV( direction, face ) * ( faceSize - 2.0 ) + 1.0;
		if ( face > 2.0 ) {
			uv.y += faceSize;
			face -= 3.0;
		}
		uv.x += face * faceSize;
		uv.x += filterInt * 3.0 * cubeUV_minTileSize;
		uv.y += 4.0 * ( exp2( CUBEUV_MAX_MIP ) - faceSize );
		uv.x *= CUBEUV_TEXEL_WIDTH;
		uv.y *= CUBEUV_TEXEL_HEIGHT;
		#ifdef texture2DGradEXT
			return texture2DGradEXT( envMap, uv, vec2( 0.0 ), vec2( 0.0 ) ).rgb;
		#else
			return texture2D( envMap, uv ).rgb;
		#endif
	}
	#define cubeUV_r0 1.0
	#define cubeUV_m0 - 2.0
	#define cubeUV_r1 0.8
	#define cubeUV_m1 - 1.0
	#define cubeUV_r4 0.4
	#define cubeUV_m4 2.0
	#define cubeUV_r5 0.305
	#define cubeUV_m5 3.0
	#define cubeUV_r6 0.21
	#define cubeUV_m6 4.0
	float roughnessToMip( float roughness ) {
		float mip = 0.0;
		if ( roughness >= cubeUV_r1 ) {
			mip = ( cubeUV_r0 - roughness ) * ( cubeUV_m1 - cubeUV_m0 ) / ( cubeUV_r0 - cubeUV_r1 ) + cubeUV_m0;
		} else if ( roughness >= cubeUV_r4 ) {
			mip = ( cubeUV_r1 - roughness ) * ( cubeUV_m4 - cubeUV_m1 ) / ( cubeUV_r1 - cubeUV_r4 ) + cubeUV_m1;
		} else if ( roughness >= cubeUV_r5 ) {
			mip = ( cubeUV_r4 - roughness ) * ( cubeUV_m5 - cubeUV_m4 ) / ( cubeUV_r4 - cubeUV_r5 ) + cubeUV_m4;
		} else if ( roughness >= cubeUV_r6 ) {
			mip = ( cubeUV_r5 - roughness ) * ( cubeUV_m6 - cubeUV_m5 ) / ( cubeUV_r5 - cubeUV_r6 ) + cubeUV_m5;
		} else {
			mip = - 2.0 * log2( 1.16 * roughness );		}
		return mip;
	}
	vec4 textureCubeUV( sampler2D envMap, vec3 sampleDir, float roughness ) {
		float mip = clamp( roughnessToMip( roughness ), cubeUV_m0, CUBEUV_MAX_MIP );
		float mipF = fract( mip );
		float mipInt = floor( mip );
		vec3 color0 = bilinearCubeUV( envMap, sampleDir, mipInt );
		if ( mipF == 0.0 ) {
			return vec4( color0, 1.0 );
		} else {
			vec3 color1 = bilinearCubeUV( envMap, sampleDir, mipInt + 1.0 );
			return vec4( mix( color0, color1, mipF ), 1.0 );
		}
	}
#endif`,m0=`vec3 transformedNormal = objectNormal;
#ifdef USE_TANGENT
	vec3 transformedTangent = objectTangent;
#endif
#ifdef USE_BATCHING
	mat3 bm = mat3( batchingMatrix );
	transformedNormal /= vec3( dot( bm[ 0 ], bm[ 0 ] ), dot( bm[ 1 ], bm[ 1 ] ), dot( bm[ 2 ], bm[ 2 ] ) );
	transformedNormal = bm * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = bm * transformedTangent;
	#endif
#endif
#ifdef USE_INSTANCING
	mat3 im = mat3( instanceMatrix );
	transformedNormal /= vec3( dot( im[ 0 ], im[ 0 ] ), dot( im[ 1 ], im[ 1 ] ), dot( im[ 2 ], im[ 2 ] ) );
	transformedNormal = im * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = im * transformedTangent;
	#endif
#endif
transformedNormal = normalMatrix * transformedNormal;
#ifdef FLIP_SIDED
	transformedNormal = - transformedNormal;
#endif
#ifdef USE_TANGENT
	transformedTangent = ( modelViewMatrix * vec4( transformedTangent, 0.0 ) ).xyz;
	#ifdef FLIP_SIDED
		transformedTangent = - transformedTangent;
	#endif
#endif`,g0=`#ifdef USE_DISPLACEMENTMAP
	uniform sampler2D displacementMap;
	uniform float displacementScale;
	uniform float displacementBias;
#endif`,_0=`#ifdef USE_DISPLACEMENTMAP
	transformed += normalize( objectNormal ) * ( texture2D( displacementMap, vDisplacementMapUv ).x * displacementScale + displacementBias );
#endif`,v0=`#ifdef USE_EMISSIVEMAP
	vec4 emissiveColor = texture2D( emissiveMap, vEmissiveMapUv );
	totalEmissiveRadiance *= emissiveColor.rgb;
#endif`,x0=`#ifdef USE_EMISSIVEMAP
	uniform sampler2D emissiveMap;
#endif`,M0="gl_FragColor = linearToOutputTexel( gl_FragColor );",y0=`
const mat3 LINEAR_SRGB_TO_LINEAR_DISPLAY_P3 = mat3(
	vec3( 0.8224621, 0.177538, 0.0 ),
	vec3( 0.0331941, 0.9668058, 0.0 ),
	vec3( 0.0170827, 0.0723974, 0.9105199 )
);
const mat3 LINEAR_DISPLAY_P3_TO_LINEAR_SRGB = mat3(
	vec3( 1.2249401, - 0.2249404, 0.0 ),
	vec3( - 0.0420569, 1.0420571, 0.0 ),
	vec3( - 0.0196376, - 0.0786361, 1.0982735 )
);
vec4 LinearSRGBToLinearDisplayP3( in vec4 value ) {
	return vec4( value.rgb * LINEAR_SRGB_TO_LINEAR_DISPLAY_P3, value.a );
}
vec4 LinearDisplayP3ToLinearSRGB( in vec4 value ) {
	return vec4( value.rgb * LINEAR_DISPLAY_P3_TO_LINEAR_SRGB, value.a );
}
vec4 LinearTransferOETF( in vec4 value ) {
	return value;
}
vec4 sRGBTransferOETF( in vec4 value ) {
	return vec4( mix( pow( value.rgb, vec3( 0.41666 ) ) * 1.055 - vec3( 0.055 ), value.rgb * 12.92, vec3( lessThanEqual( value.rgb, vec3( 0.0031308 ) ) ) ), value.a );
}`,S0=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vec3 cameraToFrag;
		if ( isOrthographic ) {
			cameraToFrag = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToFrag = normalize( vWorldPosition - cameraPosition );
		}
		vec3 worldNormal = inverseTransformDirection( normal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vec3 reflectVec = reflect( cameraToFrag, worldNormal );
		#else
			vec3 reflectVec = refract( cameraToFrag, worldNormal, refractionRatio );
		#endif
	#else
		vec3 reflectVec = vReflect;
	#endif
	#ifdef ENVMAP_TYPE_CUBE
		vec4 envColor = textureCube( envMap, envMapRotation * vec3( flipEnvMap * reflectVec.x, reflectVec.yz ) );
	#else
		vec4 envColor = vec4( 0.0 );
	#endif
	#ifdef ENVMAP_BLENDING_MULTIPLY
		outgoingLight = mix( outgoingLight, outgoingLight * envColor.xyz, specularStrength * reflectivity );
	#elif defined( ENVMAP_BLENDING_MIX )
		outgoingLight = mix( outgoingLight, envColor.xyz, specularStrength * reflectivity );
	#elif defined( ENVMAP_BLENDING_ADD )
		outgoingLight += envColor.xyz * specularStrength * reflectivity;
	#endif
#endif`,E0=`#ifdef USE_ENVMAP
	uniform float envMapIntensity;
	uniform float flipEnvMap;
	uniform mat3 envMapRotation;
	#ifdef ENVMAP_TYPE_CUBE
		uniform samplerCube envMap;
	#else
		uniform sampler2D envMap;
	#endif
	
#endif`,w0=`#ifdef USE_ENVMAP
	uniform float reflectivity;
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		varying vec3 vWorldPosition;
		uniform float refractionRatio;
	#else
		varying vec3 vReflect;
	#endif
#endif`,b0=`#ifdef USE_ENVMAP
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		
		varying vec3 vWorldPosition;
	#else
		varying vec3 vReflect;
		uniform float refractionRatio;
	#endif
#endif`,T0=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vWorldPosition = worldPosition.xyz;
	#else
		vec3 cameraToVertex;
		if ( isOrthographic ) {
			cameraToVertex = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToVertex = normalize( worldPosition.xyz - cameraPosition );
		}
		vec3 worldNormal = inverseTransformDirection( transformedNormal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vReflect = reflect( cameraToVertex, worldNormal );
		#else
			vReflect = refract( cameraToVertex, worldNormal, refractionRatio );
		#endif
	#endif
#endif`,A0=`#ifdef USE_FOG
	vFogDepth = - mvPosition.z;
#endif`,R0=`#ifdef USE_FOG
	varying float vFogDepth;
#endif`,C0=`#ifdef USE_FOG
	#ifdef FOG_EXP2
		float fogFactor = 1.0 - exp( - fogDensity * fogDensity * vFogDepth * vFogDepth );
	#else
		float fogFactor = smoothstep( fogNear, fogFar, vFogDepth );
	#endif
	gl_FragColor.rgb = mix( gl_FragColor.rgb, fogColor, fogFactor );
#endif`,P0=`#ifdef USE_FOG
	uniform vec3 fogColor;
	varying float vFogDepth;
	#ifdef FOG_EXP2
		uniform float fogDensity;
	#else
		uniform float fogNear;
		uniform float fogFar;
	#endif
#endif`,L0=`#ifdef USE_GRADIENTMAP
	uniform sampler2D gradientMap;
#endif
vec3 getGradientIrradiance( vec3 normal, vec3 lightDirection ) {
	float dotNL = dot( normal, lightDirection );
	vec2 coord = vec2( dotNL * 0.5 + 0.5, 0.0 );
	#ifdef USE_GRADIENTMAP
		return vec3( texture2D( gradientMap, coord ).r );
	#else
		vec2 fw = fwidth( coord ) * 0.5;
		return mix( vec3( 0.7 ), vec3( 1.0 ), smoothstep( 0.7 - fw.x, 0.7 + fw.x, coord.x ) );
	#endif
}`,D0=`#ifdef USE_LIGHTMAP
	uniform sampler2D lightMap;
	uniform float lightMapIntensity;
#endif`,I0=`LambertMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularStrength = specularStrength;`,U0=`varying vec3 vViewPosition;
struct LambertMaterial {
	vec3 diffuseColor;
	float specularStrength;
};
void RE_Direct_Lambert( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Lambert( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Lambert
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Lambert`,N0=`uniform bool receiveShadow;
uniform vec3 ambientLightColor;
#if defined( USE_LIGHT_PROBES )
	uniform vec3 lightProbe[ 9 ];
#endif
vec3 shGetIrradianceAt( in vec3 normal, in vec3 shCoefficients[ 9 ] ) {
	float x = normal.x, y = normal.y, z = normal.z;
	vec3 result = shCoefficients[ 0 ] * 0.886227;
	result += shCoefficients[ 1 ] * 2.0 * 0.511664 * y;
	result += shCoefficients[ 2 ] * 2.0 * 0.511664 * z;
	result += shCoefficients[ 3 ] * 2.0 * 0.511664 * x;
	result += shCoefficients[ 4 ] * 2.0 * 0.429043 * x * y;
	result += shCoefficients[ 5 ] * 2.0 * 0.429043 * y * z;
	result += shCoefficients[ 6 ] * ( 0.743125 * z * z - 0.247708 );
	result += shCoefficients[ 7 ] * 2.0 * 0.429043 * x * z;
	result += shCoefficients[ 8 ] * 0.429043 * ( x * x - y * y );
	return result;
}
vec3 getLightProbeIrradiance( const in vec3 lightProbe[ 9 ], const in vec3 normal ) {
	vec3 worldNormal = inverseTransformDirection( normal, viewMatrix );
	vec3 irradiance = shGetIrradianceAt( worldNormal, lightProbe );
	return irradiance;
}
vec3 getAmbientLightIrradiance( const in vec3 ambientLightColor ) {
	vec3 irradiance = ambientLightColor;
	return irradiance;
}
float getDistanceAttenuation( const in float lightDistance, const in float cutoffDistance, const in float decayExponent ) {
	float distanceFalloff = 1.0 / max( pow( lightDistance, decayExponent ), 0.01 );
	if ( cutoffDistance > 0.0 ) {
		distanceFalloff *= pow2( saturate( 1.0 - pow4( lightDistance / cutoffDistance ) ) );
	}
	return distanceFalloff;
}
float getSpotAttenuation( const in float coneCosine, const in float penumbraCosine, const in float angleCosine ) {
	return smoothstep( coneCosine, penumbraCosine, angleCosine );
}
#if NUM_DIR_LIGHTS > 0
	struct DirectionalLight {
		vec3 direction;
		vec3 color;
	};
	uniform DirectionalLight directionalLights[ NUM_DIR_LIGHTS ];
	void getDirectionalLightInfo( const in DirectionalLight directionalLight, out IncidentLight light ) {
		light.color = directionalLight.color;
		light.direction = directionalLight.direction;
		light.visible = true;
	}
#endif
#if NUM_POINT_LIGHTS > 0
	struct PointLight {
		vec3 position;
		vec3 color;
		float distance;
		float decay;
	};
	uniform PointLight pointLights[ NUM_POINT_LIGHTS ];
	void getPointLightInfo( const in PointLight pointLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = pointLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float lightDistance = length( lVector );
		light.color = pointLight.color;
		light.color *= getDistanceAttenuation( lightDistance, pointLight.distance, pointLight.decay );
		light.visible = ( light.color != vec3( 0.0 ) );
	}
#endif
#if NUM_SPOT_LIGHTS > 0
	struct SpotLight {
		vec3 position;
		vec3 direction;
		vec3 color;
		float distance;
		float decay;
		float coneCos;
		float penumbraCos;
	};
	uniform SpotLight spotLights[ NUM_SPOT_LIGHTS ];
	void getSpotLightInfo( const in SpotLight spotLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = spotLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float angleCos = dot( light.direction, spotLight.direction );
		float spotAttenuation = getSpotAttenuation( spotLight.coneCos, spotLight.penumbraCos, angleCos );
		if ( spotAttenuation > 0.0 ) {
			float lightDistance = length( lVector );
			light.color = spotLight.color * spotAttenuation;
			light.color *= getDistanceAttenuation( lightDistance, spotLight.distance, spotLight.decay );
			light.visible = ( light.color != vec3( 0.0 ) );
		} else {
			light.color = vec3( 0.0 );
			light.visible = false;
		}
	}
#endif
#if NUM_RECT_AREA_LIGHTS > 0
	struct RectAreaLight {
		vec3 color;
		vec3 position;
		vec3 halfWidth;
		vec3 halfHeight;
	};
	uniform sampler2D ltc_1;	uniform sampler2D ltc_2;
	uniform RectAreaLight rectAreaLights[ NUM_RECT_AREA_LIGHTS ];
#endif
#if NUM_HEMI_LIGHTS > 0
	struct HemisphereLight {
		vec3 direction;
		vec3 skyColor;
		vec3 groundColor;
	};
	uniform HemisphereLight hemisphereLights[ NUM_HEMI_LIGHTS ];
	vec3 getHemisphereLightIrradiance( const in HemisphereLight hemiLight, const in vec3 normal ) {
		float dotNL = dot( normal, hemiLight.direction );
		float hemiDiffuseWeight = 0.5 * dotNL + 0.5;
		vec3 irradiance = mix( hemiLight.groundColor, hemiLight.skyColor, hemiDiffuseWeight );
		return irradiance;
	}
#endif`,k0=`#ifdef USE_ENVMAP
	vec3 getIBLIrradiance( const in vec3 normal ) {
		#ifdef ENVMAP_TYPE_CUBE_UV
			vec3 worldNormal = inverseTransformDirection( normal, viewMatrix );
			vec4 envMapColor = textureCubeUV( envMap, envMapRotation * worldNormal, 1.0 );
			return PI * envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	vec3 getIBLRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
		#ifdef ENVMAP_TYPE_CUBE_UV
			vec3 reflectVec = reflect( - viewDir, normal );
			reflectVec = normalize( mix( reflectVec, normal, roughness * roughness) );
			reflectVec = inverseTransformDirection( reflectVec, viewMatrix );
			vec4 envMapColor = textureCubeUV( envMap, envMapRotation * reflectVec, roughness );
			return envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	#ifdef USE_ANISOTROPY
		vec3 getIBLAnisotropyRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
			#ifdef ENVMAP_TYPE_CUBE_UV
				vec3 bentNormal = cross( bitangent, viewDir );
				bentNormal = normalize( cross( bentNormal, bitangent ) );
				bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
				return getIBLRadiance( viewDir, bentNormal, roughness );
			#else
				return vec3( 0.0 );
			#endif
		}
	#endif
#endif`,O0=`ToonMaterial material;
material.diffuseColor = diffuseColor.rgb;`,F0=`varying vec3 vViewPosition;
struct ToonMaterial {
	vec3 diffuseColor;
};
void RE_Direct_Toon( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 irradiance = getGradientIrradiance( geometryNormal, directLight.direction ) * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Toon( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Toon
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Toon`,B0=`BlinnPhongMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularColor = specular;
material.specularShininess = shininess;
material.specularStrength = specularStrength;`,z0=`varying vec3 vViewPosition;
struct BlinnPhongMaterial {
	vec3 diffuseColor;
	vec3 specularColor;
	float specularShininess;
	float specularStrength;
};
void RE_Direct_BlinnPhong( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
	reflectedLight.directSpecular += irradiance * BRDF_BlinnPhong( directLight.direction, geometryViewDir, geometryNormal, material.specularColor, material.specularShininess ) * material.specularStrength;
}
void RE_IndirectDiffuse_BlinnPhong( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_BlinnPhong
#define RE_IndirectDiffuse		RE_IndirectDiffuse_BlinnPhong`,H0=`PhysicalMaterial material;
material.diffuseColor = diffuseColor.rgb * ( 1.0 - metalnessFactor );
vec3 dxy = max( abs( dFdx( nonPerturbedNormal ) ), abs( dFdy( nonPerturbedNormal ) ) );
float geometryRoughness = max( max( dxy.x, dxy.y ), dxy.z );
material.roughness = max( roughnessFactor, 0.0525 );material.roughness += geometryRoughness;
material.roughness = min( material.roughness, 1.0 );
#ifdef IOR
	material.ior = ior;
	#ifdef USE_SPECULAR
		float specularIntensityFactor = specularIntensity;
		vec3 specularColorFactor = specularColor;
		#ifdef USE_SPECULAR_COLORMAP
			specularColorFactor *= texture2D( specularColorMap, vSpecularColorMapUv ).rgb;
		#endif
		#ifdef USE_SPECULAR_INTENSITYMAP
			specularIntensityFactor *= texture2D( specularIntensityMap, vSpecularIntensityMapUv ).a;
		#endif
		material.specularF90 = mix( specularIntensityFactor, 1.0, metalnessFactor );
	#else
		float specularIntensityFactor = 1.0;
		vec3 specularColorFactor = vec3( 1.0 );
		material.specularF90 = 1.0;
	#endif
	material.specularColor = mix( min( pow2( ( material.ior - 1.0 ) / ( material.ior + 1.0 ) ) * specularColorFactor, vec3( 1.0 ) ) * specularIntensityFactor, diffuseColor.rgb, metalnessFactor );
#else
	material.specularColor = mix( vec3( 0.04 ), diffuseColor.rgb, metalnessFactor );
	material.specularF90 = 1.0;
#endif
#ifdef USE_CLEARCOAT
	material.clearcoat = clearcoat;
	material.clearcoatRoughness = clearcoatRoughness;
	material.clearcoatF0 = vec3( 0.04 );
	material.clearcoatF90 = 1.0;
	#ifdef USE_CLEARCOATMAP
		material.clearcoat *= texture2D( clearcoatMap, vClearcoatMapUv ).x;
	#endif
	#ifdef USE_CLEARCOAT_ROUGHNESSMAP
		material.clearcoatRoughness *= texture2D( clearcoatRoughnessMap, vClearcoatRoughnessMapUv ).y;
	#endif
	material.clearcoat = saturate( material.clearcoat );	material.clearcoatRoughness = max( material.clearcoatRoughness, 0.0525 );
	material.clearcoatRoughness += geometryRoughness;
	material.clearcoatRoughness = min( material.clearcoatRoughness, 1.0 );
#endif
#ifdef USE_DISPERSION
	material.dispersion = dispersion;
#endif
#ifdef USE_IRIDESCENCE
	material.iridescence = iridescence;
	material.iridescenceIOR = iridescenceIOR;
	#ifdef USE_IRIDESCENCEMAP
		material.iridescence *= texture2D( iridescenceMap, vIridescenceMapUv ).r;
	#endif
	#ifdef USE_IRIDESCENCE_THICKNESSMAP
		material.iridescenceThickness = (iridescenceThicknessMaximum - iridescenceThicknessMinimum) * texture2D( iridescenceThicknessMap, vIridescenceThicknessMapUv ).g + iridescenceThicknessMinimum;
	#else
		material.iridescenceThickness = iridescenceThicknessMaximum;
	#endif
#endif
#ifdef USE_SHEEN
	material.sheenColor = sheenColor;
	#ifdef USE_SHEEN_COLORMAP
		material.sheenColor *= texture2D( sheenColorMap, vSheenColorMapUv ).rgb;
	#endif
	material.sheenRoughness = clamp( sheenRoughness, 0.07, 1.0 );
	#ifdef USE_SHEEN_ROUGHNESSMAP
		material.sheenRoughness *= texture2D( sheenRoughnessMap, vSheenRoughnessMapUv ).a;
	#endif
#endif
#ifdef USE_ANISOTROPY
	#ifdef USE_ANISOTROPYMAP
		mat2 anisotropyMat = mat2( anisotropyVector.x, anisotropyVector.y, - anisotropyVector.y, anisotropyVector.x );
		vec3 anisotropyPolar = texture2D( anisotropyMap, vAnisotropyMapUv ).rgb;
		vec2 anisotropyV = anisotropyMat * normalize( 2.0 * anisotropyPolar.rg - vec2( 1.0 ) ) * anisotropyPolar.b;
	#else
		vec2 anisotropyV = anisotropyVector;
	#endif
	material.anisotropy = length( anisotropyV );
	if( material.anisotropy == 0.0 ) {
		anisotropyV = vec2( 1.0, 0.0 );
	} else {
		anisotropyV /= material.anisotropy;
		material.anisotropy = saturate( material.anisotropy );
	}
	material.alphaT = mix( pow2( material.roughness ), 1.0, pow2( material.anisotropy ) );
	material.anisotropyT = tbn[ 0 ] * anisotropyV.x + tbn[ 1 ] * anisotropyV.y;
	material.anisotropyB = tbn[ 1 ] * anisotropyV.x - tbn[ 0 ] * anisotropyV.y;
#endif`,G0=`struct PhysicalMaterial {
	vec3 diffuseColor;
	float roughness;
	vec3 specularColor;
	float specularF90;
	float dispersion;
	#ifdef USE_CLEARCOAT
		float clearcoat;
		float clearcoatRoughness;
		vec3 clearcoatF0;
		float clearcoatF90;
	#endif
	#ifdef USE_IRIDESCENCE
		float iridescence;
		float iridescenceIOR;
		float iridescenceThickness;
		vec3 iridescenceFresnel;
		vec3 iridescenceF0;
	#endif
	#ifdef USE_SHEEN
		vec3 sheenColor;
		float sheenRoughness;
	#endif
	#ifdef IOR
		float ior;
	#endif
	#ifdef USE_TRANSMISSION
		float transmission;
		float transmissionAlpha;
		float thickness;
		float attenuationDistance;
		vec3 attenuationColor;
	#endif
	#ifdef USE_ANISOTROPY
		float anisotropy;
		float alphaT;
		vec3 anisotropyT;
		vec3 anisotropyB;
	#endif
};
vec3 clearcoatSpecularDirect = vec3( 0.0 );
vec3 clearcoatSpecularIndirect = vec3( 0.0 );
vec3 sheenSpecularDirect = vec3( 0.0 );
vec3 sheenSpecularIndirect = vec3(0.0 );
vec3 Schlick_to_F0( const in vec3 f, const in float f90, const in float dotVH ) {
    float x = clamp( 1.0 - dotVH, 0.0, 1.0 );
    float x2 = x * x;
    float x5 = clamp( x * x2 * x2, 0.0, 0.9999 );
    return ( f - vec3( f90 ) * x5 ) / ( 1.0 - x5 );
}
float V_GGX_SmithCorrelated( const in float alpha, const in float dotNL, const in float dotNV ) {
	float a2 = pow2( alpha );
	float gv = dotNL * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNV ) );
	float gl = dotNV * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNL ) );
	return 0.5 / max( gv + gl, EPSILON );
}
float D_GGX( const in float alpha, const in float dotNH ) {
	float a2 = pow2( alpha );
	float denom = pow2( dotNH ) * ( a2 - 1.0 ) + 1.0;
	return RECIPROCAL_PI * a2 / pow2( denom );
}
#ifdef USE_ANISOTROPY
	float V_GGX_SmithCorrelated_Anisotropic( const in float alphaT, const in float alphaB, const in float dotTV, const in float dotBV, const in float dotTL, const in float dotBL, const in float dotNV, const in float dotNL ) {
		float gv = dotNL * length( vec3( alphaT * dotTV, alphaB * dotBV, dotNV ) );
		float gl = dotNV * length( vec3( alphaT * dotTL, alphaB * dotBL, dotNL ) );
		float v = 0.5 / ( gv + gl );
		return saturate(v);
	}
	float D_GGX_Anisotropic( const in float alphaT, const in float alphaB, const in float dotNH, const in float dotTH, const in float dotBH ) {
		float a2 = alphaT * alphaB;
		highp vec3 v = vec3( alphaB * dotTH, alphaT * dotBH, a2 * dotNH );
		highp float v2 = dot( v, v );
		float w2 = a2 / v2;
		return RECIPROCAL_PI * a2 * pow2 ( w2 );
	}
#endif
#ifdef USE_CLEARCOAT
	vec3 BRDF_GGX_Clearcoat( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material) {
		vec3 f0 = material.clearcoatF0;
		float f90 = material.clearcoatF90;
		float roughness = material.clearcoatRoughness;
		float alpha = pow2( roughness );
		vec3 halfDir = normalize( lightDir + viewDir );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float dotNH = saturate( dot( normal, halfDir ) );
		float dotVH = saturate( dot( viewDir, halfDir ) );
		vec3 F = F_Schlick( f0, f90, dotVH );
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
		return F * ( V * D );
	}
#endif
vec3 BRDF_GGX( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material ) {
	vec3 f0 = material.specularColor;
	float f90 = material.specularF90;
	float roughness = material.roughness;
	float alpha = pow2( roughness );
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( f0, f90, dotVH );
	#ifdef USE_IRIDESCENCE
		F = mix( F, material.iridescenceFresnel, material.iridescence );
	#endif
	#ifdef USE_ANISOTROPY
		float dotTL = dot( material.anisotropyT, lightDir );
		float dotTV = dot( material.anisotropyT, viewDir );
		float dotTH = dot( material.anisotropyT, halfDir );
		float dotBL = dot( material.anisotropyB, lightDir );
		float dotBV = dot( material.anisotropyB, viewDir );
		float dotBH = dot( material.anisotropyB, halfDir );
		float V = V_GGX_SmithCorrelated_Anisotropic( material.alphaT, alpha, dotTV, dotBV, dotTL, dotBL, dotNV, dotNL );
		float D = D_GGX_Anisotropic( material.alphaT, alpha, dotNH, dotTH, dotBH );
	#else
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
	#endif
	return F * ( V * D );
}
vec2 LTC_Uv( const in vec3 N, const in vec3 V, const in float roughness ) {
	const float LUT_SIZE = 64.0;
	const float LUT_SCALE = ( LUT_SIZE - 1.0 ) / LUT_SIZE;
	const float LUT_BIAS = 0.5 / LUT_SIZE;
	float dotNV = saturate( dot( N, V ) );
	vec2 uv = vec2( roughness, sqrt( 1.0 - dotNV ) );
	uv = uv * LUT_SCALE + LUT_BIAS;
	return uv;
}
float LTC_ClippedSphereFormFactor( const in vec3 f ) {
	float l = length( f );
	return max( ( l * l + f.z ) / ( l + 1.0 ), 0.0 );
}
vec3 LTC_EdgeVectorFormFactor( const in vec3 v1, const in vec3 v2 ) {
	float x = dot( v1, v2 );
	float y = abs( x );
	float a = 0.8543985 + ( 0.4965155 + 0.0145206 * y ) * y;
	float b = 3.4175940 + ( 4.1616724 + y ) * y;
	float v = a / b;
	float theta_sintheta = ( x > 0.0 ) ? v : 0.5 * inversesqrt( max( 1.0 - x * x, 1e-7 ) ) - v;
	return cross( v1, v2 ) * theta_sintheta;
}
vec3 LTC_Evaluate( const in vec3 N, const in vec3 V, const in vec3 P, const in mat3 mInv, const in vec3 rectCoords[ 4 ] ) {
	vec3 v1 = rectCoords[ 1 ] - rectCoords[ 0 ];
	vec3 v2 = rectCoords[ 3 ] - rectCoords[ 0 ];
	vec3 lightNormal = cross( v1, v2 );
	if( dot( lightNormal, P - rectCoords[ 0 ] ) < 0.0 ) return vec3( 0.0 );
	vec3 T1, T2;
	T1 = normalize( V - N * dot( V, N ) );
	T2 = - cross( N, T1 );
	mat3 mat = mInv * transposeMat3( mat3( T1, T2, N ) );
	vec3 coords[ 4 ];
	coords[ 0 ] = mat * ( rectCoords[ 0 ] - P );
	coords[ 1 ] = mat * ( rectCoords[ 1 ] - P );
	coords[ 2 ] = mat * ( rectCoords[ 2 ] - P );
	coords[ 3 ] = mat * ( rectCoords[ 3 ] - P );
	coords[ 0 ] = normalize( coords[ 0 ] );
	coords[ 1 ] = normalize( coords[ 1 ] );
	coords[ 2 ] = normalize( coords[ 2 ] );
	coords[ 3 ] = normalize( coords[ 3 ] );
	vec3 vectorFormFactor = vec3( 0.0 );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 0 ], coords[ 1 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 1 ], coords[ 2 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 2 ], coords[ 3 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 3 ], coords[ 0 ] );
	float result = LTC_ClippedSphereFormFactor( vectorFormFactor );
	return vec3( result );
}
#if defined( USE_SHEEN )
float D_Charlie( float roughness, float dotNH ) {
	float alpha = pow2( roughness );
	float invAlpha = 1.0 / alpha;
	float cos2h = dotNH * dotNH;
	float sin2h = max( 1.0 - cos2h, 0.0078125 );
	return ( 2.0 + invAlpha ) * pow( sin2h, invAlpha * 0.5 ) / ( 2.0 * PI );
}
float V_Neubelt( float dotNV, float dotNL ) {
	return saturate( 1.0 / ( 4.0 * ( dotNL + dotNV - dotNL * dotNV ) ) );
}
vec3 BRDF_Sheen( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, vec3 sheenColor, const in float sheenRoughness ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float D = D_Charlie( sheenRoughness, dotNH );
	float V = V_Neubelt( dotNV, dotNL );
	return sheenColor * ( D * V );
}
#endif
float IBLSheenBRDF( const in vec3 normal, const in vec3 viewDir, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	float r2 = roughness * roughness;
	float a = roughness < 0.25 ? -339.2 * r2 + 161.4 * roughness - 25.9 : -8.48 * r2 + 14.3 * roughness - 9.95;
	float b = roughness < 0.25 ? 44.0 * r2 - 23.7 * roughness + 3.26 : 1.97 * r2 - 3.27 * roughness + 0.72;
	float DG = exp( a * dotNV + b ) + ( roughness < 0.25 ? 0.0 : 0.1 * ( roughness - 0.25 ) );
	return saturate( DG * RECIPROCAL_PI );
}
vec2 DFGApprox( const in vec3 normal, const in vec3 viewDir, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	const vec4 c0 = vec4( - 1, - 0.0275, - 0.572, 0.022 );
	const vec4 c1 = vec4( 1, 0.0425, 1.04, - 0.04 );
	vec4 r = roughness * c0 + c1;
	float a004 = min( r.x * r.x, exp2( - 9.28 * dotNV ) ) * r.x + r.y;
	vec2 fab = vec2( - 1.04, 1.04 ) * a004 + r.zw;
	return fab;
}
vec3 EnvironmentBRDF( const in vec3 normal, const in vec3 viewDir, const in vec3 specularColor, const in float specularF90, const in float roughness ) {
	vec2 fab = DFGApprox( normal, viewDir, roughness );
	return specularColor * fab.x + specularF90 * fab.y;
}
#ifdef USE_IRIDESCENCE
void computeMultiscatteringIridescence( const in vec3 normal, const in vec3 viewDir, const in vec3 specularColor, const in float specularF90, const in float iridescence, const in vec3 iridescenceF0, const in float roughness, inout vec3 singleScatter, inout vec3 multiScatter ) {
#else
void computeMultiscattering( const in vec3 normal, const in vec3 viewDir, const in vec3 specularColor, const in float specularF90, const in float roughness, inout vec3 singleScatter, inout vec3 multiScatter ) {
#endif
	vec2 fab = DFGApprox( normal, viewDir, roughness );
	#ifdef USE_IRIDESCENCE
		vec3 Fr = mix( specularColor, iridescenceF0, iridescence );
	#else
		vec3 Fr = specularColor;
	#endif
	vec3 FssEss = Fr * fab.x + specularF90 * fab.y;
	float Ess = fab.x + fab.y;
	float Ems = 1.0 - Ess;
	vec3 Favg = Fr + ( 1.0 - Fr ) * 0.047619;	vec3 Fms = FssEss * Favg / ( 1.0 - Ems * Favg );
	singleScatter += FssEss;
	multiScatter += Fms * Ems;
}
#if NUM_RECT_AREA_LIGHTS > 0
	void RE_Direct_RectArea_Physical( const in RectAreaLight rectAreaLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
		vec3 normal = geometryNormal;
		vec3 viewDir = geometryViewDir;
		vec3 position = geometryPosition;
		vec3 lightPos = rectAreaLight.position;
		vec3 halfWidth = rectAreaLight.halfWidth;
		vec3 halfHeight = rectAreaLight.halfHeight;
		vec3 lightColor = rectAreaLight.color;
		float roughness = material.roughness;
		vec3 rectCoords[ 4 ];
		rectCoords[ 0 ] = lightPos + halfWidth - halfHeight;		rectCoords[ 1 ] = lightPos - halfWidth - halfHeight;
		rectCoords[ 2 ] = lightPos - halfWidth + halfHeight;
		rectCoords[ 3 ] = lightPos + halfWidth + halfHeight;
		vec2 uv = LTC_Uv( normal, viewDir, roughness );
		vec4 t1 = texture2D( ltc_1, uv );
		vec4 t2 = texture2D( ltc_2, uv );
		mat3 mInv = mat3(
			vec3( t1.x, 0, t1.y ),
			vec3(    0, 1,    0 ),
			vec3( t1.z, 0, t1.w )
		);
		vec3 fresnel = ( material.specularColor * t2.x + ( vec3( 1.0 ) - material.specularColor ) * t2.y );
		reflectedLight.directSpecular += lightColor * fresnel * LTC_Evaluate( normal, viewDir, position, mInv, rectCoords );
		reflectedLight.directDiffuse += lightColor * material.diffuseColor * LTC_Evaluate( normal, viewDir, position, mat3( 1.0 ), rectCoords );
	}
#endif
void RE_Direct_Physical( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	#ifdef USE_CLEARCOAT
		float dotNLcc = saturate( dot( geometryClearcoatNormal, directLight.direction ) );
		vec3 ccIrradiance = dotNLcc * directLight.color;
		clearcoatSpecularDirect += ccIrradiance * BRDF_GGX_Clearcoat( directLight.direction, geometryViewDir, geometryClearcoatNormal, material );
	#endif
	#ifdef USE_SHEEN
		sheenSpecularDirect += irradiance * BRDF_Sheen( directLight.direction, geometryViewDir, geometryNormal, material.sheenColor, material.sheenRoughness );
	#endif
	reflectedLight.directSpecular += irradiance * BRDF_GGX( directLight.direction, geometryViewDir, geometryNormal, material );
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Physical( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectSpecular_Physical( const in vec3 radiance, const in vec3 irradiance, const in vec3 clearcoatRadiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight) {
	#ifdef USE_CLEARCOAT
		clearcoatSpecularIndirect += clearcoatRadiance * EnvironmentBRDF( geometryClearcoatNormal, geometryViewDir, material.clearcoatF0, material.clearcoatF90, material.clearcoatRoughness );
	#endif
	#ifdef USE_SHEEN
		sheenSpecularIndirect += irradiance * material.sheenColor * IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
	#endif
	vec3 singleScattering = vec3( 0.0 );
	vec3 multiScattering = vec3( 0.0 );
	vec3 cosineWeightedIrradiance = irradiance * RECIPROCAL_PI;
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( geometryNormal, geometryViewDir, material.specularColor, material.specularF90, material.iridescence, material.iridescenceFresnel, material.roughness, singleScattering, multiScattering );
	#else
		computeMultiscattering( geometryNormal, geometryViewDir, material.specularColor, material.specularF90, material.roughness, singleScattering, multiScattering );
	#endif
	vec3 totalScattering = singleScattering + multiScattering;
	vec3 diffuse = material.diffuseColor * ( 1.0 - max( max( totalScattering.r, totalScattering.g ), totalScattering.b ) );
	reflectedLight.indirectSpecular += radiance * singleScattering;
	reflectedLight.indirectSpecular += multiScattering * cosineWeightedIrradiance;
	reflectedLight.indirectDiffuse += diffuse * cosineWeightedIrradiance;
}
#define RE_Direct				RE_Direct_Physical
#define RE_Direct_RectArea		RE_Direct_RectArea_Physical
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Physical
#define RE_IndirectSpecular		RE_IndirectSpecular_Physical
float computeSpecularOcclusion( const in float dotNV, const in float ambientOcclusion, const in float roughness ) {
	return saturate( pow( dotNV + ambientOcclusion, exp2( - 16.0 * roughness - 1.0 ) ) - 1.0 + ambientOcclusion );
}`,V0=`
vec3 geometryPosition = - vViewPosition;
vec3 geometryNormal = normal;
vec3 geometryViewDir = ( isOrthographic ) ? vec3( 0, 0, 1 ) : normalize( vViewPosition );
vec3 geometryClearcoatNormal = vec3( 0.0 );
#ifdef USE_CLEARCOAT
	geometryClearcoatNormal = clearcoatNormal;
#endif
#ifdef USE_IRIDESCENCE
	float dotNVi = saturate( dot( normal, geometryViewDir ) );
	if ( material.iridescenceThickness == 0.0 ) {
		material.iridescence = 0.0;
	} else {
		material.iridescence = saturate( material.iridescence );
	}
	if ( material.iridescence > 0.0 ) {
		material.iridescenceFresnel = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.specularColor );
		material.iridescenceF0 = Schlick_to_F0( material.iridescenceFresnel, 1.0, dotNVi );
	}
#endif
IncidentLight directLight;
#if ( NUM_POINT_LIGHTS > 0 ) && defined( RE_Direct )
	PointLight pointLight;
	#if defined( USE_SHADOWMAP ) && NUM_POINT_LIGHT_SHADOWS > 0
	PointLightShadow pointLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHTS; i ++ ) {
		pointLight = pointLights[ i ];
		getPointLightInfo( pointLight, geometryPosition, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_POINT_LIGHT_SHADOWS )
		pointLightShadow = pointLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getPointShadow( pointShadowMap[ i ], pointLightShadow.shadowMapSize, pointLightShadow.shadowIntensity, pointLightShadow.shadowBias, pointLightShadow.shadowRadius, vPointShadowCoord[ i ], pointLightShadow.shadowCameraNear, pointLightShadow.shadowCameraFar ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SPOT_LIGHTS > 0 ) && defined( RE_Direct )
	SpotLight spotLight;
	vec4 spotColor;
	vec3 spotLightCoord;
	bool inSpotLightMap;
	#if defined( USE_SHADOWMAP ) && NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHTS; i ++ ) {
		spotLight = spotLights[ i ];
		getSpotLightInfo( spotLight, geometryPosition, directLight );
		#if ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#define SPOT_LIGHT_MAP_INDEX UNROLLED_LOOP_INDEX
		#elif ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		#define SPOT_LIGHT_MAP_INDEX NUM_SPOT_LIGHT_MAPS
		#else
		#define SPOT_LIGHT_MAP_INDEX ( UNROLLED_LOOP_INDEX - NUM_SPOT_LIGHT_SHADOWS + NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#endif
		#if ( SPOT_LIGHT_MAP_INDEX < NUM_SPOT_LIGHT_MAPS )
			spotLightCoord = vSpotLightCoord[ i ].xyz / vSpotLightCoord[ i ].w;
			inSpotLightMap = all( lessThan( abs( spotLightCoord * 2. - 1. ), vec3( 1.0 ) ) );
			spotColor = texture2D( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], spotLightCoord.xy );
			directLight.color = inSpotLightMap ? directLight.color * spotColor.rgb : directLight.color;
		#endif
		#undef SPOT_LIGHT_MAP_INDEX
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		spotLightShadow = spotLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( spotShadowMap[ i ], spotLightShadow.shadowMapSize, spotLightShadow.shadowIntensity, spotLightShadow.shadowBias, spotLightShadow.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_DIR_LIGHTS > 0 ) && defined( RE_Direct )
	DirectionalLight directionalLight;
	#if defined( USE_SHADOWMAP ) && NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHTS; i ++ ) {
		directionalLight = directionalLights[ i ];
		getDirectionalLightInfo( directionalLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_DIR_LIGHT_SHADOWS )
		directionalLightShadow = directionalLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( directionalShadowMap[ i ], directionalLightShadow.shadowMapSize, directionalLightShadow.shadowIntensity, directionalLightShadow.shadowBias, directionalLightShadow.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_RECT_AREA_LIGHTS > 0 ) && defined( RE_Direct_RectArea )
	RectAreaLight rectAreaLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_RECT_AREA_LIGHTS; i ++ ) {
		rectAreaLight = rectAreaLights[ i ];
		RE_Direct_RectArea( rectAreaLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if defined( RE_IndirectDiffuse )
	vec3 iblIrradiance = vec3( 0.0 );
	vec3 irradiance = getAmbientLightIrradiance( ambientLightColor );
	#if defined( USE_LIGHT_PROBES )
		irradiance += getLightProbeIrradiance( lightProbe, geometryNormal );
	#endif
	#if ( NUM_HEMI_LIGHTS > 0 )
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_HEMI_LIGHTS; i ++ ) {
			irradiance += getHemisphereLightIrradiance( hemisphereLights[ i ], geometryNormal );
		}
		#pragma unroll_loop_end
	#endif
#endif
#if defined( RE_IndirectSpecular )
	vec3 radiance = vec3( 0.0 );
	vec3 clearcoatRadiance = vec3( 0.0 );
#endif`,W0=`#if defined( RE_IndirectDiffuse )
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		vec3 lightMapIrradiance = lightMapTexel.rgb * lightMapIntensity;
		irradiance += lightMapIrradiance;
	#endif
	#if defined( USE_ENVMAP ) && defined( STANDARD ) && defined( ENVMAP_TYPE_CUBE_UV )
		iblIrradiance += getIBLIrradiance( geometryNormal );
	#endif
#endif
#if defined( USE_ENVMAP ) && defined( RE_IndirectSpecular )
	#ifdef USE_ANISOTROPY
		radiance += getIBLAnisotropyRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
	#else
		radiance += getIBLRadiance( geometryViewDir, geometryNormal, material.roughness );
	#endif
	#ifdef USE_CLEARCOAT
		clearcoatRadiance += getIBLRadiance( geometryViewDir, geometryClearcoatNormal, material.clearcoatRoughness );
	#endif
#endif`,X0=`#if defined( RE_IndirectDiffuse )
	RE_IndirectDiffuse( irradiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif
#if defined( RE_IndirectSpecular )
	RE_IndirectSpecular( radiance, iblIrradiance, clearcoatRadiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif`,q0=`#if defined( USE_LOGDEPTHBUF )
	gl_FragDepth = vIsPerspective == 0.0 ? gl_FragCoord.z : log2( vFragDepth ) * logDepthBufFC * 0.5;
#endif`,Y0=`#if defined( USE_LOGDEPTHBUF )
	uniform float logDepthBufFC;
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,j0=`#ifdef USE_LOGDEPTHBUF
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,K0=`#ifdef USE_LOGDEPTHBUF
	vFragDepth = 1.0 + gl_Position.w;
	vIsPerspective = float( isPerspectiveMatrix( projectionMatrix ) );
#endif`,$0=`#ifdef USE_MAP
	vec4 sampledDiffuseColor = texture2D( map, vMapUv );
	#ifdef DECODE_VIDEO_TEXTURE
		sampledDiffuseColor = vec4( mix( pow( sampledDiffuseColor.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), sampledDiffuseColor.rgb * 0.0773993808, vec3( lessThanEqual( sampledDiffuseColor.rgb, vec3( 0.04045 ) ) ) ), sampledDiffuseColor.w );
	
	#endif
	diffuseColor *= sampledDiffuseColor;
#endif`,Z0=`#ifdef USE_MAP
	uniform sampler2D map;
#endif`,J0=`#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
	#if defined( USE_POINTS_UV )
		vec2 uv = vUv;
	#else
		vec2 uv = ( uvTransform * vec3( gl_PointCoord.x, 1.0 - gl_PointCoord.y, 1 ) ).xy;
	#endif
#endif
#ifdef USE_MAP
	diffuseColor *= texture2D( map, uv );
#endif
#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, uv ).g;
#endif`,Q0=`#if defined( USE_POINTS_UV )
	varying vec2 vUv;
#else
	#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
		uniform mat3 uvTransform;
	#endif
#endif
#ifdef USE_MAP
	uniform sampler2D map;
#endif
#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,tv=`float metalnessFactor = metalness;
#ifdef USE_METALNESSMAP
	vec4 texelMetalness = texture2D( metalnessMap, vMetalnessMapUv );
	metalnessFactor *= texelMetalness.b;
#endif`,ev=`#ifdef USE_METALNESSMAP
	uniform sampler2D metalnessMap;
#endif`,nv=`#ifdef USE_INSTANCING_MORPH
	float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	float morphTargetBaseInfluence = texelFetch( morphTexture, ivec2( 0, gl_InstanceID ), 0 ).r;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		morphTargetInfluences[i] =  texelFetch( morphTexture, ivec2( i + 1, gl_InstanceID ), 0 ).r;
	}
#endif`,iv=`#if defined( USE_MORPHCOLORS )
	vColor *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		#if defined( USE_COLOR_ALPHA )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor += getMorph( gl_VertexID, i, 2 ) * morphTargetInfluences[ i ];
		#elif defined( USE_COLOR )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor += getMorph( gl_VertexID, i, 2 ).rgb * morphTargetInfluences[ i ];
		#endif
	}
#endif`,sv=`#ifdef USE_MORPHNORMALS
	objectNormal *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) objectNormal += getMorph( gl_VertexID, i, 1 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,rv=`#ifdef USE_MORPHTARGETS
	#ifndef USE_INSTANCING_MORPH
		uniform float morphTargetBaseInfluence;
		uniform float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	#endif
	uniform sampler2DArray morphTargetsTexture;
	uniform ivec2 morphTargetsTextureSize;
	vec4 getMorph( const in int vertexIndex, const in int morphTargetIndex, const in int offset ) {
		int texelIndex = vertexIndex * MORPHTARGETS_TEXTURE_STRIDE + offset;
		int y = texelIndex / morphTargetsTextureSize.x;
		int x = texelIndex - y * morphTargetsTextureSize.x;
		ivec3 morphUV = ivec3( x, y, morphTargetIndex );
		return texelFetch( morphTargetsTexture, morphUV, 0 );
	}
#endif`,ov=`#ifdef USE_MORPHTARGETS
	transformed *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) transformed += getMorph( gl_VertexID, i, 0 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,av=`float faceDirection = gl_FrontFacing ? 1.0 : - 1.0;
#ifdef FLAT_SHADED
	vec3 fdx = dFdx( vViewPosition );
	vec3 fdy = dFdy( vViewPosition );
	vec3 normal = normalize( cross( fdx, fdy ) );
#else
	vec3 normal = normalize( vNormal );
	#ifdef DOUBLE_SIDED
		normal *= faceDirection;
	#endif
#endif
#if defined( USE_NORMALMAP_TANGENTSPACE ) || defined( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY )
	#ifdef USE_TANGENT
		mat3 tbn = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn = getTangentFrame( - vViewPosition, normal,
		#if defined( USE_NORMALMAP )
			vNormalMapUv
		#elif defined( USE_CLEARCOAT_NORMALMAP )
			vClearcoatNormalMapUv
		#else
			vUv
		#endif
		);
	#endif
	#if defined( DOUBLE_SIDED ) && ! defined( FLAT_SHADED )
		tbn[0] *= faceDirection;
		tbn[1] *= faceDirection;
	#endif
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	#ifdef USE_TANGENT
		mat3 tbn2 = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn2 = getTangentFrame( - vViewPosition, normal, vClearcoatNormalMapUv );
	#endif
	#if defined( DOUBLE_SIDED ) && ! defined( FLAT_SHADED )
		tbn2[0] *= faceDirection;
		tbn2[1] *= faceDirection;
	#endif
#endif
vec3 nonPerturbedNormal = normal;`,lv=`#ifdef USE_NORMALMAP_OBJECTSPACE
	normal = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#ifdef FLIP_SIDED
		normal = - normal;
	#endif
	#ifdef DOUBLE_SIDED
		normal = normal * faceDirection;
	#endif
	normal = normalize( normalMatrix * normal );
#elif defined( USE_NORMALMAP_TANGENTSPACE )
	vec3 mapN = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	mapN.xy *= normalScale;
	normal = normalize( tbn * mapN );
#elif defined( USE_BUMPMAP )
	normal = perturbNormalArb( - vViewPosition, normal, dHdxy_fwd(), faceDirection );
#endif`,cv=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,hv=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,uv=`#ifndef FLAT_SHADED
	vNormal = normalize( transformedNormal );
	#ifdef USE_TANGENT
		vTangent = normalize( transformedTangent );
		vBitangent = normalize( cross( vNormal, vTangent ) * tangent.w );
	#endif
#endif`,fv=`#ifdef USE_NORMALMAP
	uniform sampler2D normalMap;
	uniform vec2 normalScale;
#endif
#ifdef USE_NORMALMAP_OBJECTSPACE
	uniform mat3 normalMatrix;
#endif
#if ! defined ( USE_TANGENT ) && ( defined ( USE_NORMALMAP_TANGENTSPACE ) || defined ( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY ) )
	mat3 getTangentFrame( vec3 eye_pos, vec3 surf_norm, vec2 uv ) {
		vec3 q0 = dFdx( eye_pos.xyz );
		vec3 q1 = dFdy( eye_pos.xyz );
		vec2 st0 = dFdx( uv.st );
		vec2 st1 = dFdy( uv.st );
		vec3 N = surf_norm;
		vec3 q1perp = cross( q1, N );
		vec3 q0perp = cross( N, q0 );
		vec3 T = q1perp * st0.x + q0perp * st1.x;
		vec3 B = q1perp * st0.y + q0perp * st1.y;
		float det = max( dot( T, T ), dot( B, B ) );
		float scale = ( det == 0.0 ) ? 0.0 : inversesqrt( det );
		return mat3( T * scale, B * scale, N );
	}
#endif`,dv=`#ifdef USE_CLEARCOAT
	vec3 clearcoatNormal = nonPerturbedNormal;
#endif`,pv=`#ifdef USE_CLEARCOAT_NORMALMAP
	vec3 clearcoatMapN = texture2D( clearcoatNormalMap, vClearcoatNormalMapUv ).xyz * 2.0 - 1.0;
	clearcoatMapN.xy *= clearcoatNormalScale;
	clearcoatNormal = normalize( tbn2 * clearcoatMapN );
#endif`,mv=`#ifdef USE_CLEARCOATMAP
	uniform sampler2D clearcoatMap;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform sampler2D clearcoatNormalMap;
	uniform vec2 clearcoatNormalScale;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform sampler2D clearcoatRoughnessMap;
#endif`,gv=`#ifdef USE_IRIDESCENCEMAP
	uniform sampler2D iridescenceMap;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform sampler2D iridescenceThicknessMap;
#endif`,_v=`#ifdef OPAQUE
diffuseColor.a = 1.0;
#endif
#ifdef USE_TRANSMISSION
diffuseColor.a *= material.transmissionAlpha;
#endif
gl_FragColor = vec4( outgoingLight, diffuseColor.a );`,vv=`vec3 packNormalToRGB( const in vec3 normal ) {
	return normalize( normal ) * 0.5 + 0.5;
}
vec3 unpackRGBToNormal( const in vec3 rgb ) {
	return 2.0 * rgb.xyz - 1.0;
}
const float PackUpscale = 256. / 255.;const float UnpackDownscale = 255. / 256.;const float ShiftRight8 = 1. / 256.;
const float Inv255 = 1. / 255.;
const vec4 PackFactors = vec4( 1.0, 256.0, 256.0 * 256.0, 256.0 * 256.0 * 256.0 );
const vec2 UnpackFactors2 = vec2( UnpackDownscale, 1.0 / PackFactors.g );
const vec3 UnpackFactors3 = vec3( UnpackDownscale / PackFactors.rg, 1.0 / PackFactors.b );
const vec4 UnpackFactors4 = vec4( UnpackDownscale / PackFactors.rgb, 1.0 / PackFactors.a );
vec4 packDepthToRGBA( const in float v ) {
	if( v <= 0.0 )
		return vec4( 0., 0., 0., 0. );
	if( v >= 1.0 )
		return vec4( 1., 1., 1., 1. );
	float vuf;
	float af = modf( v * PackFactors.a, vuf );
	float bf = modf( vuf * ShiftRight8, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec4( vuf * Inv255, gf * PackUpscale, bf * PackUpscale, af );
}
vec3 packDepthToRGB( const in float v ) {
	if( v <= 0.0 )
		return vec3( 0., 0., 0. );
	if( v >= 1.0 )
		return vec3( 1., 1., 1. );
	float vuf;
	float bf = modf( v * PackFactors.b, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec3( vuf * Inv255, gf * PackUpscale, bf );
}
vec2 packDepthToRG( const in float v ) {
	if( v <= 0.0 )
		return vec2( 0., 0. );
	if( v >= 1.0 )
		return vec2( 1., 1. );
	float vuf;
	float gf = modf( v * 256., vuf );
	return vec2( vuf * Inv255, gf );
}
float unpackRGBAToDepth( const in vec4 v ) {
	return dot( v, UnpackFactors4 );
}
float unpackRGBToDepth( const in vec3 v ) {
	return dot( v, UnpackFactors3 );
}
float unpackRGToDepth( const in vec2 v ) {
	return v.r * UnpackFactors2.r + v.g * UnpackFactors2.g;
}
vec4 pack2HalfToRGBA( const in vec2 v ) {
	vec4 r = vec4( v.x, fract( v.x * 255.0 ), v.y, fract( v.y * 255.0 ) );
	return vec4( r.x - r.y / 255.0, r.y, r.z - r.w / 255.0, r.w );
}
vec2 unpackRGBATo2Half( const in vec4 v ) {
	return vec2( v.x + ( v.y / 255.0 ), v.z + ( v.w / 255.0 ) );
}
float viewZToOrthographicDepth( const in float viewZ, const in float near, const in float far ) {
	return ( viewZ + near ) / ( near - far );
}
float orthographicDepthToViewZ( const in float depth, const in float near, const in float far ) {
	return depth * ( near - far ) - near;
}
float viewZToPerspectiveDepth( const in float viewZ, const in float near, const in float far ) {
	return ( ( near + viewZ ) * far ) / ( ( far - near ) * viewZ );
}
float perspectiveDepthToViewZ( const in float depth, const in float near, const in float far ) {
	return ( near * far ) / ( ( far - near ) * depth - far );
}`,xv=`#ifdef PREMULTIPLIED_ALPHA
	gl_FragColor.rgb *= gl_FragColor.a;
#endif`,Mv=`vec4 mvPosition = vec4( transformed, 1.0 );
#ifdef USE_BATCHING
	mvPosition = batchingMatrix * mvPosition;
#endif
#ifdef USE_INSTANCING
	mvPosition = instanceMatrix * mvPosition;
#endif
mvPosition = modelViewMatrix * mvPosition;
gl_Position = projectionMatrix * mvPosition;`,yv=`#ifdef DITHERING
	gl_FragColor.rgb = dithering( gl_FragColor.rgb );
#endif`,Sv=`#ifdef DITHERING
	vec3 dithering( vec3 color ) {
		float grid_position = rand( gl_FragCoord.xy );
		vec3 dither_shift_RGB = vec3( 0.25 / 255.0, -0.25 / 255.0, 0.25 / 255.0 );
		dither_shift_RGB = mix( 2.0 * dither_shift_RGB, -2.0 * dither_shift_RGB, grid_position );
		return color + dither_shift_RGB;
	}
#endif`,Ev=`float roughnessFactor = roughness;
#ifdef USE_ROUGHNESSMAP
	vec4 texelRoughness = texture2D( roughnessMap, vRoughnessMapUv );
	roughnessFactor *= texelRoughness.g;
#endif`,wv=`#ifdef USE_ROUGHNESSMAP
	uniform sampler2D roughnessMap;
#endif`,bv=`#if NUM_SPOT_LIGHT_COORDS > 0
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#if NUM_SPOT_LIGHT_MAPS > 0
	uniform sampler2D spotLightMap[ NUM_SPOT_LIGHT_MAPS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_DIR_LIGHT_SHADOWS > 0
		uniform sampler2D directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		uniform sampler2D spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		uniform sampler2D pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
	float texture2DCompare( sampler2D depths, vec2 uv, float compare ) {
		return step( compare, unpackRGBAToDepth( texture2D( depths, uv ) ) );
	}
	vec2 texture2DDistribution( sampler2D shadow, vec2 uv ) {
		return unpackRGBATo2Half( texture2D( shadow, uv ) );
	}
	float VSMShadow (sampler2D shadow, vec2 uv, float compare ){
		float occlusion = 1.0;
		vec2 distribution = texture2DDistribution( shadow, uv );
		float hard_shadow = step( compare , distribution.x );
		if (hard_shadow != 1.0 ) {
			float distance = compare - distribution.x ;
			float variance = max( 0.00000, distribution.y * distribution.y );
			float softness_probability = variance / (variance + distance * distance );			softness_probability = clamp( ( softness_probability - 0.3 ) / ( 0.95 - 0.3 ), 0.0, 1.0 );			occlusion = clamp( max( hard_shadow, softness_probability ), 0.0, 1.0 );
		}
		return occlusion;
	}
	float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
		float shadow = 1.0;
		shadowCoord.xyz /= shadowCoord.w;
		shadowCoord.z += shadowBias;
		bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
		bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
		if ( frustumTest ) {
		#if defined( SHADOWMAP_TYPE_PCF )
			vec2 texelSize = vec2( 1.0 ) / shadowMapSize;
			float dx0 = - texelSize.x * shadowRadius;
			float dy0 = - texelSize.y * shadowRadius;
			float dx1 = + texelSize.x * shadowRadius;
			float dy1 = + texelSize.y * shadowRadius;
			float dx2 = dx0 / 2.0;
			float dy2 = dy0 / 2.0;
			float dx3 = dx1 / 2.0;
			float dy3 = dy1 / 2.0;
			shadow = (
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( dx0, dy0 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( 0.0, dy0 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( dx1, dy0 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( dx2, dy2 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( 0.0, dy2 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( dx3, dy2 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( dx0, 0.0 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( dx2, 0.0 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy, shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( dx3, 0.0 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( dx1, 0.0 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( dx2, dy3 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( 0.0, dy3 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( dx3, dy3 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( dx0, dy1 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( 0.0, dy1 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( dx1, dy1 ), shadowCoord.z )
			) * ( 1.0 / 17.0 );
		#elif defined( SHADOWMAP_TYPE_PCF_SOFT )
			vec2 texelSize = vec2( 1.0 ) / shadowMapSize;
			float dx = texelSize.x;
			float dy = texelSize.y;
			vec2 uv = shadowCoord.xy;
			vec2 f = fract( uv * shadowMapSize + 0.5 );
			uv -= f * texelSize;
			shadow = (
				texture2DCompare( shadowMap, uv, shadowCoord.z ) +
				texture2DCompare( shadowMap, uv + vec2( dx, 0.0 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, uv + vec2( 0.0, dy ), shadowCoord.z ) +
				texture2DCompare( shadowMap, uv + texelSize, shadowCoord.z ) +
				mix( texture2DCompare( shadowMap, uv + vec2( -dx, 0.0 ), shadowCoord.z ),
					 texture2DCompare( shadowMap, uv + vec2( 2.0 * dx, 0.0 ), shadowCoord.z ),
					 f.x ) +
				mix( texture2DCompare( shadowMap, uv + vec2( -dx, dy ), shadowCoord.z ),
					 texture2DCompare( shadowMap, uv + vec2( 2.0 * dx, dy ), shadowCoord.z ),
					 f.x ) +
				mix( texture2DCompare( shadowMap, uv + vec2( 0.0, -dy ), shadowCoord.z ),
					 texture2DCompare( shadowMap, uv + vec2( 0.0, 2.0 * dy ), shadowCoord.z ),
					 f.y ) +
				mix( texture2DCompare( shadowMap, uv + vec2( dx, -dy ), shadowCoord.z ),
					 texture2DCompare( shadowMap, uv + vec2( dx, 2.0 * dy ), shadowCoord.z ),
					 f.y ) +
				mix( mix( texture2DCompare( shadowMap, uv + vec2( -dx, -dy ), shadowCoord.z ),
						  texture2DCompare( shadowMap, uv + vec2( 2.0 * dx, -dy ), shadowCoord.z ),
						  f.x ),
					 mix( texture2DCompare( shadowMap, uv + vec2( -dx, 2.0 * dy ), shadowCoord.z ),
						  texture2DCompare( shadowMap, uv + vec2( 2.0 * dx, 2.0 * dy ), shadowCoord.z ),
						  f.x ),
					 f.y )
			) * ( 1.0 / 9.0 );
		#elif defined( SHADOWMAP_TYPE_VSM )
			shadow = VSMShadow( shadowMap, shadowCoord.xy, shadowCoord.z );
		#else
			shadow = texture2DCompare( shadowMap, shadowCoord.xy, shadowCoord.z );
		#endif
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	vec2 cubeToUV( vec3 v, float texelSizeY ) {
		vec3 absV = abs( v );
		float scaleToCube = 1.0 / max( absV.x, max( absV.y, absV.z ) );
		absV *= scaleToCube;
		v *= scaleToCube * ( 1.0 - 2.0 * texelSizeY );
		vec2 planar = v.xy;
		float almostATexel = 1.5 * texelSizeY;
		float almostOne = 1.0 - almostATexel;
		if ( absV.z >= almostOne ) {
			if ( v.z > 0.0 )
				planar.x = 4.0 - v.x;
		} else if ( absV.x >= almostOne ) {
			float signX = sign( v.x );
			planar.x = v.z * signX + 2.0 * signX;
		} else if ( absV.y >= almostOne ) {
			float signY = sign( v.y );
			planar.x = v.x + 2.0 * signY + 2.0;
			planar.y = v.z * signY - 2.0;
		}
		return vec2( 0.125, 0.25 ) * planar + vec2( 0.375, 0.75 );
	}
	float getPointShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		
		float lightToPositionLength = length( lightToPosition );
		if ( lightToPositionLength - shadowCameraFar <= 0.0 && lightToPositionLength - shadowCameraNear >= 0.0 ) {
			float dp = ( lightToPositionLength - shadowCameraNear ) / ( shadowCameraFar - shadowCameraNear );			dp += shadowBias;
			vec3 bd3D = normalize( lightToPosition );
			vec2 texelSize = vec2( 1.0 ) / ( shadowMapSize * vec2( 4.0, 2.0 ) );
			#if defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_PCF_SOFT ) || defined( SHADOWMAP_TYPE_VSM )
				vec2 offset = vec2( - 1, 1 ) * shadowRadius * texelSize.y;
				shadow = (
					texture2DCompare( shadowMap, cubeToUV( bd3D + offset.xyy, texelSize.y ), dp ) +
					texture2DCompare( shadowMap, cubeToUV( bd3D + offset.yyy, texelSize.y ), dp ) +
					texture2DCompare( shadowMap, cubeToUV( bd3D + offset.xyx, texelSize.y ), dp ) +
					texture2DCompare( shadowMap, cubeToUV( bd3D + offset.yyx, texelSize.y ), dp ) +
					texture2DCompare( shadowMap, cubeToUV( bd3D, texelSize.y ), dp ) +
					texture2DCompare( shadowMap, cubeToUV( bd3D + offset.xxy, texelSize.y ), dp ) +
					texture2DCompare( shadowMap, cubeToUV( bd3D + offset.yxy, texelSize.y ), dp ) +
					texture2DCompare( shadowMap, cubeToUV( bd3D + offset.xxx, texelSize.y ), dp ) +
					texture2DCompare( shadowMap, cubeToUV( bd3D + offset.yxx, texelSize.y ), dp )
				) * ( 1.0 / 9.0 );
			#else
				shadow = texture2DCompare( shadowMap, cubeToUV( bd3D, texelSize.y ), dp );
			#endif
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
#endif`,Tv=`#if NUM_SPOT_LIGHT_COORDS > 0
	uniform mat4 spotLightMatrix[ NUM_SPOT_LIGHT_COORDS ];
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_DIR_LIGHT_SHADOWS > 0
		uniform mat4 directionalShadowMatrix[ NUM_DIR_LIGHT_SHADOWS ];
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		uniform mat4 pointShadowMatrix[ NUM_POINT_LIGHT_SHADOWS ];
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
#endif`,Av=`#if ( defined( USE_SHADOWMAP ) && ( NUM_DIR_LIGHT_SHADOWS > 0 || NUM_POINT_LIGHT_SHADOWS > 0 ) ) || ( NUM_SPOT_LIGHT_COORDS > 0 )
	vec3 shadowWorldNormal = inverseTransformDirection( transformedNormal, viewMatrix );
	vec4 shadowWorldPosition;
#endif
#if defined( USE_SHADOWMAP )
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * directionalLightShadows[ i ].shadowNormalBias, 0 );
			vDirectionalShadowCoord[ i ] = directionalShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * pointLightShadows[ i ].shadowNormalBias, 0 );
			vPointShadowCoord[ i ] = pointShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
#endif
#if NUM_SPOT_LIGHT_COORDS > 0
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_COORDS; i ++ ) {
		shadowWorldPosition = worldPosition;
		#if ( defined( USE_SHADOWMAP ) && UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
			shadowWorldPosition.xyz += shadowWorldNormal * spotLightShadows[ i ].shadowNormalBias;
		#endif
		vSpotLightCoord[ i ] = spotLightMatrix[ i ] * shadowWorldPosition;
	}
	#pragma unroll_loop_end
#endif`,Rv=`float getShadowMask() {
	float shadow = 1.0;
	#ifdef USE_SHADOWMAP
	#if NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
		directionalLight = directionalLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( directionalShadowMap[ i ], directionalLight.shadowMapSize, directionalLight.shadowIntensity, directionalLight.shadowBias, directionalLight.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_SHADOWS; i ++ ) {
		spotLight = spotLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( spotShadowMap[ i ], spotLight.shadowMapSize, spotLight.shadowIntensity, spotLight.shadowBias, spotLight.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
	PointLightShadow pointLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
		pointLight = pointLightShadows[ i ];
		shadow *= receiveShadow ? getPointShadow( pointShadowMap[ i ], pointLight.shadowMapSize, pointLight.shadowIntensity, pointLight.shadowBias, pointLight.shadowRadius, vPointShadowCoord[ i ], pointLight.shadowCameraNear, pointLight.shadowCameraFar ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#endif
	return shadow;
}`,Cv=`#ifdef USE_SKINNING
	mat4 boneMatX = getBoneMatrix( skinIndex.x );
	mat4 boneMatY = getBoneMatrix( skinIndex.y );
	mat4 boneMatZ = getBoneMatrix( skinIndex.z );
	mat4 boneMatW = getBoneMatrix( skinIndex.w );
#endif`,Pv=`#ifdef USE_SKINNING
	uniform mat4 bindMatrix;
	uniform mat4 bindMatrixInverse;
	uniform highp sampler2D boneTexture;
	mat4 getBoneMatrix( const in float i ) {
		int size = textureSize( boneTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( boneTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( boneTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( boneTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( boneTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
#endif`,Lv=`#ifdef USE_SKINNING
	vec4 skinVertex = bindMatrix * vec4( transformed, 1.0 );
	vec4 skinned = vec4( 0.0 );
	skinned += boneMatX * skinVertex * skinWeight.x;
	skinned += boneMatY * skinVertex * skinWeight.y;
	skinned += boneMatZ * skinVertex * skinWeight.z;
	skinned += boneMatW * skinVertex * skinWeight.w;
	transformed = ( bindMatrixInverse * skinned ).xyz;
#endif`,Dv=`#ifdef USE_SKINNING
	mat4 skinMatrix = mat4( 0.0 );
	skinMatrix += skinWeight.x * boneMatX;
	skinMatrix += skinWeight.y * boneMatY;
	skinMatrix += skinWeight.z * boneMatZ;
	skinMatrix += skinWeight.w * boneMatW;
	skinMatrix = bindMatrixInverse * skinMatrix * bindMatrix;
	objectNormal = vec4( skinMatrix * vec4( objectNormal, 0.0 ) ).xyz;
	#ifdef USE_TANGENT
		objectTangent = vec4( skinMatrix * vec4( objectTangent, 0.0 ) ).xyz;
	#endif
#endif`,Iv=`float specularStrength;
#ifdef USE_SPECULARMAP
	vec4 texelSpecular = texture2D( specularMap, vSpecularMapUv );
	specularStrength = texelSpecular.r;
#else
	specularStrength = 1.0;
#endif`,Uv=`#ifdef USE_SPECULARMAP
	uniform sampler2D specularMap;
#endif`,Nv=`#if defined( TONE_MAPPING )
	gl_FragColor.rgb = toneMapping( gl_FragColor.rgb );
#endif`,kv=`#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
uniform float toneMappingExposure;
vec3 LinearToneMapping( vec3 color ) {
	return saturate( toneMappingExposure * color );
}
vec3 ReinhardToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	return saturate( color / ( vec3( 1.0 ) + color ) );
}
vec3 CineonToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	color = max( vec3( 0.0 ), color - 0.004 );
	return pow( ( color * ( 6.2 * color + 0.5 ) ) / ( color * ( 6.2 * color + 1.7 ) + 0.06 ), vec3( 2.2 ) );
}
vec3 RRTAndODTFit( vec3 v ) {
	vec3 a = v * ( v + 0.0245786 ) - 0.000090537;
	vec3 b = v * ( 0.983729 * v + 0.4329510 ) + 0.238081;
	return a / b;
}
vec3 ACESFilmicToneMapping( vec3 color ) {
	const mat3 ACESInputMat = mat3(
		vec3( 0.59719, 0.07600, 0.02840 ),		vec3( 0.35458, 0.90834, 0.13383 ),
		vec3( 0.04823, 0.01566, 0.83777 )
	);
	const mat3 ACESOutputMat = mat3(
		vec3(  1.60475, -0.10208, -0.00327 ),		vec3( -0.53108,  1.10813, -0.07276 ),
		vec3( -0.07367, -0.00605,  1.07602 )
	);
	color *= toneMappingExposure / 0.6;
	color = ACESInputMat * color;
	color = RRTAndODTFit( color );
	color = ACESOutputMat * color;
	return saturate( color );
}
const mat3 LINEAR_REC2020_TO_LINEAR_SRGB = mat3(
	vec3( 1.6605, - 0.1246, - 0.0182 ),
	vec3( - 0.5876, 1.1329, - 0.1006 ),
	vec3( - 0.0728, - 0.0083, 1.1187 )
);
const mat3 LINEAR_SRGB_TO_LINEAR_REC2020 = mat3(
	vec3( 0.6274, 0.0691, 0.0164 ),
	vec3( 0.3293, 0.9195, 0.0880 ),
	vec3( 0.0433, 0.0113, 0.8956 )
);
vec3 agxDefaultContrastApprox( vec3 x ) {
	vec3 x2 = x * x;
	vec3 x4 = x2 * x2;
	return + 15.5 * x4 * x2
		- 40.14 * x4 * x
		+ 31.96 * x4
		- 6.868 * x2 * x
		+ 0.4298 * x2
		+ 0.1191 * x
		- 0.00232;
}
vec3 AgXToneMapping( vec3 color ) {
	const mat3 AgXInsetMatrix = mat3(
		vec3( 0.856627153315983, 0.137318972929847, 0.11189821299995 ),
		vec3( 0.0951212405381588, 0.761241990602591, 0.0767994186031903 ),
		vec3( 0.0482516061458583, 0.101439036467562, 0.811302368396859 )
	);
	const mat3 AgXOutsetMatrix = mat3(
		vec3( 1.1271005818144368, - 0.1413297634984383, - 0.14132976349843826 ),
		vec3( - 0.11060664309660323, 1.157823702216272, - 0.11060664309660294 ),
		vec3( - 0.016493938717834573, - 0.016493938717834257, 1.2519364065950405 )
	);
	const float AgxMinEv = - 12.47393;	const float AgxMaxEv = 4.026069;
	color *= toneMappingExposure;
	color = LINEAR_SRGB_TO_LINEAR_REC2020 * color;
	color = AgXInsetMatrix * color;
	color = max( color, 1e-10 );	color = log2( color );
	color = ( color - AgxMinEv ) / ( AgxMaxEv - AgxMinEv );
	color = clamp( color, 0.0, 1.0 );
	color = agxDefaultContrastApprox( color );
	color = AgXOutsetMatrix * color;
	color = pow( max( vec3( 0.0 ), color ), vec3( 2.2 ) );
	color = LINEAR_REC2020_TO_LINEAR_SRGB * color;
	color = clamp( color, 0.0, 1.0 );
	return color;
}
vec3 NeutralToneMapping( vec3 color ) {
	const float StartCompression = 0.8 - 0.04;
	const float Desaturation = 0.15;
	color *= toneMappingExposure;
	float x = min( color.r, min( color.g, color.b ) );
	float offset = x < 0.08 ? x - 6.25 * x * x : 0.04;
	color -= offset;
	float peak = max( color.r, max( color.g, color.b ) );
	if ( peak < StartCompression ) return color;
	float d = 1. - StartCompression;
	float newPeak = 1. - d * d / ( peak + d - StartCompression );
	color *= newPeak / peak;
	float g = 1. - 1. / ( Desaturation * ( peak - newPeak ) + 1. );
	return mix( color, vec3( newPeak ), g );
}
vec3 CustomToneMapping( vec3 color ) { return color; }`,Ov=`#ifdef USE_TRANSMISSION
	material.transmission = transmission;
	material.transmissionAlpha = 1.0;
	material.thickness = thickness;
	material.attenuationDistance = attenuationDistance;
	material.attenuationColor = attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		material.transmission *= texture2D( transmissionMap, vTransmissionMapUv ).r;
	#endif
	#ifdef USE_THICKNESSMAP
		material.thickness *= texture2D( thicknessMap, vThicknessMapUv ).g;
	#endif
	vec3 pos = vWorldPosition;
	vec3 v = normalize( cameraPosition - pos );
	vec3 n = inverseTransformDirection( normal, viewMatrix );
	vec4 transmitted = getIBLVolumeRefraction(
		n, v, material.roughness, material.diffuseColor, material.specularColor, material.specularF90,
		pos, modelMatrix, viewMatrix, projectionMatrix, material.dispersion, material.ior, material.thickness,
		material.attenuationColor, material.attenuationDistance );
	material.transmissionAlpha = mix( material.transmissionAlpha, transmitted.a, material.transmission );
	totalDiffuse = mix( totalDiffuse, transmitted.rgb, material.transmission );
#endif`,Fv=`#ifdef USE_TRANSMISSION
	uniform float transmission;
	uniform float thickness;
	uniform float attenuationDistance;
	uniform vec3 attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		uniform sampler2D transmissionMap;
	#endif
	#ifdef USE_THICKNESSMAP
		uniform sampler2D thicknessMap;
	#endif
	uniform vec2 transmissionSamplerSize;
	uniform sampler2D transmissionSamplerMap;
	uniform mat4 modelMatrix;
	uniform mat4 projectionMatrix;
	varying vec3 vWorldPosition;
	float w0( float a ) {
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - a + 3.0 ) - 3.0 ) + 1.0 );
	}
	float w1( float a ) {
		return ( 1.0 / 6.0 ) * ( a *  a * ( 3.0 * a - 6.0 ) + 4.0 );
	}
	float w2( float a ){
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - 3.0 * a + 3.0 ) + 3.0 ) + 1.0 );
	}
	float w3( float a ) {
		return ( 1.0 / 6.0 ) * ( a * a * a );
	}
	float g0( float a ) {
		return w0( a ) + w1( a );
	}
	float g1( float a ) {
		return w2( a ) + w3( a );
	}
	float h0( float a ) {
		return - 1.0 + w1( a ) / ( w0( a ) + w1( a ) );
	}
	float h1( float a ) {
		return 1.0 + w3( a ) / ( w2( a ) + w3( a ) );
	}
	vec4 bicubic( sampler2D tex, vec2 uv, vec4 texelSize, float lod ) {
		uv = uv * texelSize.zw + 0.5;
		vec2 iuv = floor( uv );
		vec2 fuv = fract( uv );
		float g0x = g0( fuv.x );
		float g1x = g1( fuv.x );
		float h0x = h0( fuv.x );
		float h1x = h1( fuv.x );
		float h0y = h0( fuv.y );
		float h1y = h1( fuv.y );
		vec2 p0 = ( vec2( iuv.x + h0x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p1 = ( vec2( iuv.x + h1x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p2 = ( vec2( iuv.x + h0x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		vec2 p3 = ( vec2( iuv.x + h1x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		return g0( fuv.y ) * ( g0x * textureLod( tex, p0, lod ) + g1x * textureLod( tex, p1, lod ) ) +
			g1( fuv.y ) * ( g0x * textureLod( tex, p2, lod ) + g1x * textureLod( tex, p3, lod ) );
	}
	vec4 textureBicubic( sampler2D sampler, vec2 uv, float lod ) {
		vec2 fLodSize = vec2( textureSize( sampler, int( lod ) ) );
		vec2 cLodSize = vec2( textureSize( sampler, int( lod + 1.0 ) ) );
		vec2 fLodSizeInv = 1.0 / fLodSize;
		vec2 cLodSizeInv = 1.0 / cLodSize;
		vec4 fSample = bicubic( sampler, uv, vec4( fLodSizeInv, fLodSize ), floor( lod ) );
		vec4 cSample = bicubic( sampler, uv, vec4( cLodSizeInv, cLodSize ), ceil( lod ) );
		return mix( fSample, cSample, fract( lod ) );
	}
	vec3 getVolumeTransmissionRay( const in vec3 n, const in vec3 v, const in float thickness, const in float ior, const in mat4 modelMatrix ) {
		vec3 refractionVector = refract( - v, normalize( n ), 1.0 / ior );
		vec3 modelScale;
		modelScale.x = length( vec3( modelMatrix[ 0 ].xyz ) );
		modelScale.y = length( vec3( modelMatrix[ 1 ].xyz ) );
		modelScale.z = length( vec3( modelMatrix[ 2 ].xyz ) );
		return normalize( refractionVector ) * thickness * modelScale;
	}
	float applyIorToRoughness( const in float roughness, const in float ior ) {
		return roughness * clamp( ior * 2.0 - 2.0, 0.0, 1.0 );
	}
	vec4 getTransmissionSample( const in vec2 fragCoord, const in float roughness, const in float ior ) {
		float lod = log2( transmissionSamplerSize.x ) * applyIorToRoughness( roughness, ior );
		return textureBicubic( transmissionSamplerMap, fragCoord.xy, lod );
	}
	vec3 volumeAttenuation( const in float transmissionDistance, const in vec3 attenuationColor, const in float attenuationDistance ) {
		if ( isinf( attenuationDistance ) ) {
			return vec3( 1.0 );
		} else {
			vec3 attenuationCoefficient = -log( attenuationColor ) / attenuationDistance;
			vec3 transmittance = exp( - attenuationCoefficient * transmissionDistance );			return transmittance;
		}
	}
	vec4 getIBLVolumeRefraction( const in vec3 n, const in vec3 v, const in float roughness, const in vec3 diffuseColor,
		const in vec3 specularColor, const in float specularF90, const in vec3 position, const in mat4 modelMatrix,
		const in mat4 viewMatrix, const in mat4 projMatrix, const in float dispersion, const in float ior, const in float thickness,
		const in vec3 attenuationColor, const in float attenuationDistance ) {
		vec4 transmittedLight;
		vec3 transmittance;
		#ifdef USE_DISPERSION
			float halfSpread = ( ior - 1.0 ) * 0.025 * dispersion;
			vec3 iors = vec3( ior - halfSpread, ior, ior + halfSpread );
			for ( int i = 0; i < 3; i ++ ) {
				vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, iors[ i ], modelMatrix );
				vec3 refractedRayExit = position + transmissionRay;
		
				vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
				vec2 refractionCoords = ndcPos.xy / ndcPos.w;
				refractionCoords += 1.0;
				refractionCoords /= 2.0;
		
				vec4 transmissionSample = getTransmissionSample( refractionCoords, roughness, iors[ i ] );
				transmittedLight[ i ] = transmissionSample[ i ];
				transmittedLight.a += transmissionSample.a;
				transmittance[ i ] = diffuseColor[ i ] * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance )[ i ];
			}
			transmittedLight.a /= 3.0;
		
		#else
		
			vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, ior, modelMatrix );
			vec3 refractedRayExit = position + transmissionRay;
			vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
			vec2 refractionCoords = ndcPos.xy / ndcPos.w;
			refractionCoords += 1.0;
			refractionCoords /= 2.0;
			transmittedLight = getTransmissionSample( refractionCoords, roughness, ior );
			transmittance = diffuseColor * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance );
		
		#endif
		vec3 attenuatedColor = transmittance * transmittedLight.rgb;
		vec3 F = EnvironmentBRDF( n, v, specularColor, specularF90, roughness );
		float transmittanceFactor = ( transmittance.r + transmittance.g + transmittance.b ) / 3.0;
		return vec4( ( 1.0 - F ) * attenuatedColor, 1.0 - ( 1.0 - transmittedLight.a ) * transmittanceFactor );
	}
#endif`,Bv=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_SPECULARMAP
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,zv=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	uniform mat3 mapTransform;
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	uniform mat3 alphaMapTransform;
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	uniform mat3 lightMapTransform;
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	uniform mat3 aoMapTransform;
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	uniform mat3 bumpMapTransform;
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	uniform mat3 normalMapTransform;
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_DISPLACEMENTMAP
	uniform mat3 displacementMapTransform;
	varying vec2 vDisplacementMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	uniform mat3 emissiveMapTransform;
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	uniform mat3 metalnessMapTransform;
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	uniform mat3 roughnessMapTransform;
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	uniform mat3 anisotropyMapTransform;
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	uniform mat3 clearcoatMapTransform;
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform mat3 clearcoatNormalMapTransform;
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform mat3 clearcoatRoughnessMapTransform;
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	uniform mat3 sheenColorMapTransform;
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	uniform mat3 sheenRoughnessMapTransform;
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	uniform mat3 iridescenceMapTransform;
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform mat3 iridescenceThicknessMapTransform;
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SPECULARMAP
	uniform mat3 specularMapTransform;
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	uniform mat3 specularColorMapTransform;
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	uniform mat3 specularIntensityMapTransform;
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,Hv=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	vUv = vec3( uv, 1 ).xy;
#endif
#ifdef USE_MAP
	vMapUv = ( mapTransform * vec3( MAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ALPHAMAP
	vAlphaMapUv = ( alphaMapTransform * vec3( ALPHAMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_LIGHTMAP
	vLightMapUv = ( lightMapTransform * vec3( LIGHTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_AOMAP
	vAoMapUv = ( aoMapTransform * vec3( AOMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_BUMPMAP
	vBumpMapUv = ( bumpMapTransform * vec3( BUMPMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_NORMALMAP
	vNormalMapUv = ( normalMapTransform * vec3( NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DISPLACEMENTMAP
	vDisplacementMapUv = ( displacementMapTransform * vec3( DISPLACEMENTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_EMISSIVEMAP
	vEmissiveMapUv = ( emissiveMapTransform * vec3( EMISSIVEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_METALNESSMAP
	vMetalnessMapUv = ( metalnessMapTransform * vec3( METALNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ROUGHNESSMAP
	vRoughnessMapUv = ( roughnessMapTransform * vec3( ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ANISOTROPYMAP
	vAnisotropyMapUv = ( anisotropyMapTransform * vec3( ANISOTROPYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOATMAP
	vClearcoatMapUv = ( clearcoatMapTransform * vec3( CLEARCOATMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	vClearcoatNormalMapUv = ( clearcoatNormalMapTransform * vec3( CLEARCOAT_NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	vClearcoatRoughnessMapUv = ( clearcoatRoughnessMapTransform * vec3( CLEARCOAT_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCEMAP
	vIridescenceMapUv = ( iridescenceMapTransform * vec3( IRIDESCENCEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	vIridescenceThicknessMapUv = ( iridescenceThicknessMapTransform * vec3( IRIDESCENCE_THICKNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_COLORMAP
	vSheenColorMapUv = ( sheenColorMapTransform * vec3( SHEEN_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	vSheenRoughnessMapUv = ( sheenRoughnessMapTransform * vec3( SHEEN_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULARMAP
	vSpecularMapUv = ( specularMapTransform * vec3( SPECULARMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_COLORMAP
	vSpecularColorMapUv = ( specularColorMapTransform * vec3( SPECULAR_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	vSpecularIntensityMapUv = ( specularIntensityMapTransform * vec3( SPECULAR_INTENSITYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_TRANSMISSIONMAP
	vTransmissionMapUv = ( transmissionMapTransform * vec3( TRANSMISSIONMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_THICKNESSMAP
	vThicknessMapUv = ( thicknessMapTransform * vec3( THICKNESSMAP_UV, 1 ) ).xy;
#endif`,Gv=`#if defined( USE_ENVMAP ) || defined( DISTANCE ) || defined ( USE_SHADOWMAP ) || defined ( USE_TRANSMISSION ) || NUM_SPOT_LIGHT_COORDS > 0
	vec4 worldPosition = vec4( transformed, 1.0 );
	#ifdef USE_BATCHING
		worldPosition = batchingMatrix * worldPosition;
	#endif
	#ifdef USE_INSTANCING
		worldPosition = instanceMatrix * worldPosition;
	#endif
	worldPosition = modelMatrix * worldPosition;
#endif`;const Vv=`varying vec2 vUv;
uniform mat3 uvTransform;
void main() {
	vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	gl_Position = vec4( position.xy, 1.0, 1.0 );
}`,Wv=`uniform sampler2D t2D;
uniform float backgroundIntensity;
varying vec2 vUv;
void main() {
	vec4 texColor = texture2D( t2D, vUv );
	#ifdef DECODE_VIDEO_TEXTURE
		texColor = vec4( mix( pow( texColor.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), texColor.rgb * 0.0773993808, vec3( lessThanEqual( texColor.rgb, vec3( 0.04045 ) ) ) ), texColor.w );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,Xv=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,qv=`#ifdef ENVMAP_TYPE_CUBE
	uniform samplerCube envMap;
#elif defined( ENVMAP_TYPE_CUBE_UV )
	uniform sampler2D envMap;
#endif
uniform float flipEnvMap;
uniform float backgroundBlurriness;
uniform float backgroundIntensity;
uniform mat3 backgroundRotation;
varying vec3 vWorldDirection;
#include <cube_uv_reflection_fragment>
void main() {
	#ifdef ENVMAP_TYPE_CUBE
		vec4 texColor = textureCube( envMap, backgroundRotation * vec3( flipEnvMap * vWorldDirection.x, vWorldDirection.yz ) );
	#elif defined( ENVMAP_TYPE_CUBE_UV )
		vec4 texColor = textureCubeUV( envMap, backgroundRotation * vWorldDirection, backgroundBlurriness );
	#else
		vec4 texColor = vec4( 0.0, 0.0, 0.0, 1.0 );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,Yv=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,jv=`uniform samplerCube tCube;
uniform float tFlip;
uniform float opacity;
varying vec3 vWorldDirection;
void main() {
	vec4 texColor = textureCube( tCube, vec3( tFlip * vWorldDirection.x, vWorldDirection.yz ) );
	gl_FragColor = texColor;
	gl_FragColor.a *= opacity;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,Kv=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
varying vec2 vHighPrecisionZW;
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vHighPrecisionZW = gl_Position.zw;
}`,$v=`#if DEPTH_PACKING == 3200
	uniform float opacity;
#endif
#include <common>
#include <packing>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
varying vec2 vHighPrecisionZW;
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#if DEPTH_PACKING == 3200
		diffuseColor.a = opacity;
	#endif
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <logdepthbuf_fragment>
	float fragCoordZ = 0.5 * vHighPrecisionZW[0] / vHighPrecisionZW[1] + 0.5;
	#if DEPTH_PACKING == 3200
		gl_FragColor = vec4( vec3( 1.0 - fragCoordZ ), opacity );
	#elif DEPTH_PACKING == 3201
		gl_FragColor = packDepthToRGBA( fragCoordZ );
	#elif DEPTH_PACKING == 3202
		gl_FragColor = vec4( packDepthToRGB( fragCoordZ ), 1.0 );
	#elif DEPTH_PACKING == 3203
		gl_FragColor = vec4( packDepthToRG( fragCoordZ ), 0.0, 1.0 );
	#endif
}`,Zv=`#define DISTANCE
varying vec3 vWorldPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <worldpos_vertex>
	#include <clipping_planes_vertex>
	vWorldPosition = worldPosition.xyz;
}`,Jv=`#define DISTANCE
uniform vec3 referencePosition;
uniform float nearDistance;
uniform float farDistance;
varying vec3 vWorldPosition;
#include <common>
#include <packing>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <clipping_planes_pars_fragment>
void main () {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	float dist = length( vWorldPosition - referencePosition );
	dist = ( dist - nearDistance ) / ( farDistance - nearDistance );
	dist = saturate( dist );
	gl_FragColor = packDepthToRGBA( dist );
}`,Qv=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
}`,tx=`uniform sampler2D tEquirect;
varying vec3 vWorldDirection;
#include <common>
void main() {
	vec3 direction = normalize( vWorldDirection );
	vec2 sampleUV = equirectUv( direction );
	gl_FragColor = texture2D( tEquirect, sampleUV );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,ex=`uniform float scale;
attribute float lineDistance;
varying float vLineDistance;
#include <common>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	vLineDistance = scale * lineDistance;
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,nx=`uniform vec3 diffuse;
uniform float opacity;
uniform float dashSize;
uniform float totalSize;
varying float vLineDistance;
#include <common>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	if ( mod( vLineDistance, totalSize ) > dashSize ) {
		discard;
	}
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,ix=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#if defined ( USE_ENVMAP ) || defined ( USE_SKINNING )
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinbase_vertex>
		#include <skinnormal_vertex>
		#include <defaultnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <fog_vertex>
}`,sx=`uniform vec3 diffuse;
uniform float opacity;
#ifndef FLAT_SHADED
	varying vec3 vNormal;
#endif
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <fog_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		reflectedLight.indirectDiffuse += lightMapTexel.rgb * lightMapIntensity * RECIPROCAL_PI;
	#else
		reflectedLight.indirectDiffuse += vec3( 1.0 );
	#endif
	#include <aomap_fragment>
	reflectedLight.indirectDiffuse *= diffuseColor.rgb;
	vec3 outgoingLight = reflectedLight.indirectDiffuse;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,rx=`#define LAMBERT
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,ox=`#define LAMBERT
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <packing>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_lambert_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_lambert_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,ax=`#define MATCAP
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <displacementmap_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
	vViewPosition = - mvPosition.xyz;
}`,lx=`#define MATCAP
uniform vec3 diffuse;
uniform float opacity;
uniform sampler2D matcap;
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	vec3 viewDir = normalize( vViewPosition );
	vec3 x = normalize( vec3( viewDir.z, 0.0, - viewDir.x ) );
	vec3 y = cross( viewDir, x );
	vec2 uv = vec2( dot( x, normal ), dot( y, normal ) ) * 0.495 + 0.5;
	#ifdef USE_MATCAP
		vec4 matcapColor = texture2D( matcap, uv );
	#else
		vec4 matcapColor = vec4( vec3( mix( 0.2, 0.8, uv.y ) ), 1.0 );
	#endif
	vec3 outgoingLight = diffuseColor.rgb * matcapColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,cx=`#define NORMAL
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	vViewPosition = - mvPosition.xyz;
#endif
}`,hx=`#define NORMAL
uniform float opacity;
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <packing>
#include <uv_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 0.0, 0.0, 0.0, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	gl_FragColor = vec4( packNormalToRGB( normal ), diffuseColor.a );
	#ifdef OPAQUE
		gl_FragColor.a = 1.0;
	#endif
}`,ux=`#define PHONG
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,fx=`#define PHONG
uniform vec3 diffuse;
uniform vec3 emissive;
uniform vec3 specular;
uniform float shininess;
uniform float opacity;
#include <common>
#include <packing>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_phong_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_phong_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + reflectedLight.directSpecular + reflectedLight.indirectSpecular + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,dx=`#define STANDARD
varying vec3 vViewPosition;
#ifdef USE_TRANSMISSION
	varying vec3 vWorldPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
#ifdef USE_TRANSMISSION
	vWorldPosition = worldPosition.xyz;
#endif
}`,px=`#define STANDARD
#ifdef PHYSICAL
	#define IOR
	#define USE_SPECULAR
#endif
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float roughness;
uniform float metalness;
uniform float opacity;
#ifdef IOR
	uniform float ior;
#endif
#ifdef USE_SPECULAR
	uniform float specularIntensity;
	uniform vec3 specularColor;
	#ifdef USE_SPECULAR_COLORMAP
		uniform sampler2D specularColorMap;
	#endif
	#ifdef USE_SPECULAR_INTENSITYMAP
		uniform sampler2D specularIntensityMap;
	#endif
#endif
#ifdef USE_CLEARCOAT
	uniform float clearcoat;
	uniform float clearcoatRoughness;
#endif
#ifdef USE_DISPERSION
	uniform float dispersion;
#endif
#ifdef USE_IRIDESCENCE
	uniform float iridescence;
	uniform float iridescenceIOR;
	uniform float iridescenceThicknessMinimum;
	uniform float iridescenceThicknessMaximum;
#endif
#ifdef USE_SHEEN
	uniform vec3 sheenColor;
	uniform float sheenRoughness;
	#ifdef USE_SHEEN_COLORMAP
		uniform sampler2D sheenColorMap;
	#endif
	#ifdef USE_SHEEN_ROUGHNESSMAP
		uniform sampler2D sheenRoughnessMap;
	#endif
#endif
#ifdef USE_ANISOTROPY
	uniform vec2 anisotropyVector;
	#ifdef USE_ANISOTROPYMAP
		uniform sampler2D anisotropyMap;
	#endif
#endif
varying vec3 vViewPosition;
#include <common>
#include <packing>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <iridescence_fragment>
#include <cube_uv_reflection_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_physical_pars_fragment>
#include <transmission_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <clearcoat_pars_fragment>
#include <iridescence_pars_fragment>
#include <roughnessmap_pars_fragment>
#include <metalnessmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <roughnessmap_fragment>
	#include <metalnessmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <clearcoat_normal_fragment_begin>
	#include <clearcoat_normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_physical_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 totalDiffuse = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse;
	vec3 totalSpecular = reflectedLight.directSpecular + reflectedLight.indirectSpecular;
	#include <transmission_fragment>
	vec3 outgoingLight = totalDiffuse + totalSpecular + totalEmissiveRadiance;
	#ifdef USE_SHEEN
		float sheenEnergyComp = 1.0 - 0.157 * max3( material.sheenColor );
		outgoingLight = outgoingLight * sheenEnergyComp + sheenSpecularDirect + sheenSpecularIndirect;
	#endif
	#ifdef USE_CLEARCOAT
		float dotNVcc = saturate( dot( geometryClearcoatNormal, geometryViewDir ) );
		vec3 Fcc = F_Schlick( material.clearcoatF0, material.clearcoatF90, dotNVcc );
		outgoingLight = outgoingLight * ( 1.0 - material.clearcoat * Fcc ) + ( clearcoatSpecularDirect + clearcoatSpecularIndirect ) * material.clearcoat;
	#endif
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,mx=`#define TOON
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,gx=`#define TOON
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <packing>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <gradientmap_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_toon_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_toon_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,_x=`uniform float size;
uniform float scale;
#include <common>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
#ifdef USE_POINTS_UV
	varying vec2 vUv;
	uniform mat3 uvTransform;
#endif
void main() {
	#ifdef USE_POINTS_UV
		vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	#endif
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	gl_PointSize = size;
	#ifdef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) gl_PointSize *= ( scale / - mvPosition.z );
	#endif
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <fog_vertex>
}`,vx=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <color_pars_fragment>
#include <map_particle_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_particle_fragment>
	#include <color_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,xx=`#include <common>
#include <batching_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <shadowmap_pars_vertex>
void main() {
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,Mx=`uniform vec3 color;
uniform float opacity;
#include <common>
#include <packing>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <logdepthbuf_pars_fragment>
#include <shadowmap_pars_fragment>
#include <shadowmask_pars_fragment>
void main() {
	#include <logdepthbuf_fragment>
	gl_FragColor = vec4( color, opacity * ( 1.0 - getShadowMask() ) );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
}`,yx=`uniform float rotation;
uniform vec2 center;
#include <common>
#include <uv_pars_vertex>
#include <fog_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	vec4 mvPosition = modelViewMatrix[ 3 ];
	vec2 scale = vec2( length( modelMatrix[ 0 ].xyz ), length( modelMatrix[ 1 ].xyz ) );
	#ifndef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) scale *= - mvPosition.z;
	#endif
	vec2 alignedPosition = ( position.xy - ( center - vec2( 0.5 ) ) ) * scale;
	vec2 rotatedPosition;
	rotatedPosition.x = cos( rotation ) * alignedPosition.x - sin( rotation ) * alignedPosition.y;
	rotatedPosition.y = sin( rotation ) * alignedPosition.x + cos( rotation ) * alignedPosition.y;
	mvPosition.xy += rotatedPosition;
	gl_Position = projectionMatrix * mvPosition;
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,Sx=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
}`,oe={alphahash_fragment:W_,alphahash_pars_fragment:X_,alphamap_fragment:q_,alphamap_pars_fragment:Y_,alphatest_fragment:j_,alphatest_pars_fragment:K_,aomap_fragment:$_,aomap_pars_fragment:Z_,batching_pars_vertex:J_,batching_vertex:Q_,begin_vertex:t0,beginnormal_vertex:e0,bsdfs:n0,iridescence_fragment:i0,bumpmap_pars_fragment:s0,clipping_planes_fragment:r0,clipping_planes_pars_fragment:o0,clipping_planes_pars_vertex:a0,clipping_planes_vertex:l0,color_fragment:c0,color_pars_fragment:h0,color_pars_vertex:u0,color_vertex:f0,common:d0,cube_uv_reflection_fragment:p0,defaultnormal_vertex:m0,displacementmap_pars_vertex:g0,displacementmap_vertex:_0,emissivemap_fragment:v0,emissivemap_pars_fragment:x0,colorspace_fragment:M0,colorspace_pars_fragment:y0,envmap_fragment:S0,envmap_common_pars_fragment:E0,envmap_pars_fragment:w0,envmap_pars_vertex:b0,envmap_physical_pars_fragment:k0,envmap_vertex:T0,fog_vertex:A0,fog_pars_vertex:R0,fog_fragment:C0,fog_pars_fragment:P0,gradientmap_pars_fragment:L0,lightmap_pars_fragment:D0,lights_lambert_fragment:I0,lights_lambert_pars_fragment:U0,lights_pars_begin:N0,lights_toon_fragment:O0,lights_toon_pars_fragment:F0,lights_phong_fragment:B0,lights_phong_pars_fragment:z0,lights_physical_fragment:H0,lights_physical_pars_fragment:G0,lights_fragment_begin:V0,lights_fragment_maps:W0,lights_fragment_end:X0,logdepthbuf_fragment:q0,logdepthbuf_pars_fragment:Y0,logdepthbuf_pars_vertex:j0,logdepthbuf_vertex:K0,map_fragment:$0,map_pars_fragment:Z0,map_particle_fragment:J0,map_particle_pars_fragment:Q0,metalnessmap_fragment:tv,metalnessmap_pars_fragment:ev,morphinstance_vertex:nv,morphcolor_vertex:iv,morphnormal_vertex:sv,morphtarget_pars_vertex:rv,morphtarget_vertex:ov,normal_fragment_begin:av,normal_fragment_maps:lv,normal_pars_fragment:cv,normal_pars_vertex:hv,normal_vertex:uv,normalmap_pars_fragment:fv,clearcoat_normal_fragment_begin:dv,clearcoat_normal_fragment_maps:pv,clearcoat_pars_fragment:mv,iridescence_pars_fragment:gv,opaque_fragment:_v,packing:vv,premultiplied_alpha_fragment:xv,project_vertex:Mv,dithering_fragment:yv,dithering_pars_fragment:Sv,roughnessmap_fragment:Ev,roughnessmap_pars_fragment:wv,shadowmap_pars_fragment:bv,shadowmap_pars_vertex:Tv,shadowmap_vertex:Av,shadowmask_pars_fragment:Rv,skinbase_vertex:Cv,skinning_pars_vertex:Pv,skinning_vertex:Lv,skinnormal_vertex:Dv,specularmap_fragment:Iv,specularmap_pars_fragment:Uv,tonemapping_fragment:Nv,tonemapping_pars_fragment:kv,transmission_fragment:Ov,transmission_pars_fragment:Fv,uv_pars_fragment:Bv,uv_pars_vertex:zv,uv_vertex:Hv,worldpos_vertex:Gv,background_vert:Vv,background_frag:Wv,backgroundCube_vert:Xv,backgroundCube_frag:qv,cube_vert:Yv,cube_frag:jv,depth_vert:Kv,depth_frag:$v,distanceRGBA_vert:Zv,distanceRGBA_frag:Jv,equirect_vert:Qv,equirect_frag:tx,linedashed_vert:ex,linedashed_frag:nx,meshbasic_vert:ix,meshbasic_frag:sx,meshlambert_vert:rx,meshlambert_frag:ox,meshmatcap_vert:ax,meshmatcap_frag:lx,meshnormal_vert:cx,meshnormal_frag:hx,meshphong_vert:ux,meshphong_frag:fx,meshphysical_vert:dx,meshphysical_frag:px,meshtoon_vert:mx,meshtoon_frag:gx,points_vert:_x,points_frag:vx,shadow_vert:xx,shadow_frag:Mx,sprite_vert:yx,sprite_frag:Sx},Pt={common:{diffuse:{value:new ee(16777215)},opacity:{value:1},map:{value:null},mapTransform:{value:new ae},alphaMap:{value:null},alphaMapTransform:{value:new ae},alphaTest:{value:0}},specularmap:{specularMap:{value:null},specularMapTransform:{value:new ae}},envmap:{envMap:{value:null},envMapRotation:{value:new ae},flipEnvMap:{value:-1},reflectivity:{value:1},ior:{value:1.5},refractionRatio:{value:.98}},aomap:{aoMap:{value:null},aoMapIntensity:{value:1},aoMapTransform:{value:new ae}},lightmap:{lightMap:{value:null},lightMapIntensity:{value:1},lightMapTransform:{value:new ae}},bumpmap:{bumpMap:{value:null},bumpMapTransform:{value:new ae},bumpScale:{value:1}},normalmap:{normalMap:{value:null},normalMapTransform:{value:new ae},normalScale:{value:new se(1,1)}},displacementmap:{displacementMap:{value:null},displacementMapTransform:{value:new ae},displacementScale:{value:1},displacementBias:{value:0}},emissivemap:{emissiveMap:{value:null},emissiveMapTransform:{value:new ae}},metalnessmap:{metalnessMap:{value:null},metalnessMapTransform:{value:new ae}},roughnessmap:{roughnessMap:{value:null},roughnessMapTransform:{value:new ae}},gradientmap:{gradientMap:{value:null}},fog:{fogDensity:{value:25e-5},fogNear:{value:1},fogFar:{value:2e3},fogColor:{value:new ee(16777215)}},lights:{ambientLightColor:{value:[]},lightProbe:{value:[]},directionalLights:{value:[],properties:{direction:{},color:{}}},directionalLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},directionalShadowMap:{value:[]},directionalShadowMatrix:{value:[]},spotLights:{value:[],properties:{color:{},position:{},direction:{},distance:{},coneCos:{},penumbraCos:{},decay:{}}},spotLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},spotLightMap:{value:[]},spotShadowMap:{value:[]},spotLightMatrix:{value:[]},pointLights:{value:[],properties:{color:{},position:{},decay:{},distance:{}}},pointLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{},shadowCameraNear:{},shadowCameraFar:{}}},pointShadowMap:{value:[]},pointShadowMatrix:{value:[]},hemisphereLights:{value:[],properties:{direction:{},skyColor:{},groundColor:{}}},rectAreaLights:{value:[],properties:{color:{},position:{},width:{},height:{}}},ltc_1:{value:null},ltc_2:{value:null}},points:{diffuse:{value:new ee(16777215)},opacity:{value:1},size:{value:1},scale:{value:1},map:{value:null},alphaMap:{value:null},alphaMapTransform:{value:new ae},alphaTest:{value:0},uvTransform:{value:new ae}},sprite:{diffuse:{value:new ee(16777215)},opacity:{value:1},center:{value:new se(.5,.5)},rotation:{value:0},map:{value:null},mapTransform:{value:new ae},alphaMap:{value:null},alphaMapTransform:{value:new ae},alphaTest:{value:0}}},yi={basic:{uniforms:An([Pt.common,Pt.specularmap,Pt.envmap,Pt.aomap,Pt.lightmap,Pt.fog]),vertexShader:oe.meshbasic_vert,fragmentShader:oe.meshbasic_frag},lambert:{uniforms:An([Pt.common,Pt.specularmap,Pt.envmap,Pt.aomap,Pt.lightmap,Pt.emissivemap,Pt.bumpmap,Pt.normalmap,Pt.displacementmap,Pt.fog,Pt.lights,{emissive:{value:new ee(0)}}]),vertexShader:oe.meshlambert_vert,fragmentShader:oe.meshlambert_frag},phong:{uniforms:An([Pt.common,Pt.specularmap,Pt.envmap,Pt.aomap,Pt.lightmap,Pt.emissivemap,Pt.bumpmap,Pt.normalmap,Pt.displacementmap,Pt.fog,Pt.lights,{emissive:{value:new ee(0)},specular:{value:new ee(1118481)},shininess:{value:30}}]),vertexShader:oe.meshphong_vert,fragmentShader:oe.meshphong_frag},standard:{uniforms:An([Pt.common,Pt.envmap,Pt.aomap,Pt.lightmap,Pt.emissivemap,Pt.bumpmap,Pt.normalmap,Pt.displacementmap,Pt.roughnessmap,Pt.metalnessmap,Pt.fog,Pt.lights,{emissive:{value:new ee(0)},roughness:{value:1},metalness:{value:0},envMapIntensity:{value:1}}]),vertexShader:oe.meshphysical_vert,fragmentShader:oe.meshphysical_frag},toon:{uniforms:An([Pt.common,Pt.aomap,Pt.lightmap,Pt.emissivemap,Pt.bumpmap,Pt.normalmap,Pt.displacementmap,Pt.gradientmap,Pt.fog,Pt.lights,{emissive:{value:new ee(0)}}]),vertexShader:oe.meshtoon_vert,fragmentShader:oe.meshtoon_frag},matcap:{uniforms:An([Pt.common,Pt.bumpmap,Pt.normalmap,Pt.displacementmap,Pt.fog,{matcap:{value:null}}]),vertexShader:oe.meshmatcap_vert,fragmentShader:oe.meshmatcap_frag},points:{uniforms:An([Pt.points,Pt.fog]),vertexShader:oe.points_vert,fragmentShader:oe.points_frag},dashed:{uniforms:An([Pt.common,Pt.fog,{scale:{value:1},dashSize:{value:1},totalSize:{value:2}}]),vertexShader:oe.linedashed_vert,fragmentShader:oe.linedashed_frag},depth:{uniforms:An([Pt.common,Pt.displacementmap]),vertexShader:oe.depth_vert,fragmentShader:oe.depth_frag},normal:{uniforms:An([Pt.common,Pt.bumpmap,Pt.normalmap,Pt.displacementmap,{opacity:{value:1}}]),vertexShader:oe.meshnormal_vert,fragmentShader:oe.meshnormal_frag},sprite:{uniforms:An([Pt.sprite,Pt.fog]),vertexShader:oe.sprite_vert,fragmentShader:oe.sprite_frag},background:{uniforms:{uvTransform:{value:new ae},t2D:{value:null},backgroundIntensity:{value:1}},vertexShader:oe.background_vert,fragmentShader:oe.background_frag},backgroundCube:{uniforms:{envMap:{value:null},flipEnvMap:{value:-1},backgroundBlurriness:{value:0},backgroundIntensity:{value:1},backgroundRotation:{value:new ae}},vertexShader:oe.backgroundCube_vert,fragmentShader:oe.backgroundCube_frag},cube:{uniforms:{tCube:{value:null},tFlip:{value:-1},opacity:{value:1}},vertexShader:oe.cube_vert,fragmentShader:oe.cube_frag},equirect:{uniforms:{tEquirect:{value:null}},vertexShader:oe.equirect_vert,fragmentShader:oe.equirect_frag},distanceRGBA:{uniforms:An([Pt.common,Pt.displacementmap,{referencePosition:{value:new $},nearDistance:{value:1},farDistance:{value:1e3}}]),vertexShader:oe.distanceRGBA_vert,fragmentShader:oe.distanceRGBA_frag},shadow:{uniforms:An([Pt.lights,Pt.fog,{color:{value:new ee(0)},opacity:{value:1}}]),vertexShader:oe.shadow_vert,fragmentShader:oe.shadow_frag}};yi.physical={uniforms:An([yi.standard.uniforms,{clearcoat:{value:0},clearcoatMap:{value:null},clearcoatMapTransform:{value:new ae},clearcoatNormalMap:{value:null},clearcoatNormalMapTransform:{value:new ae},clearcoatNormalScale:{value:new se(1,1)},clearcoatRoughness:{value:0},clearcoatRoughnessMap:{value:null},clearcoatRoughnessMapTransform:{value:new ae},dispersion:{value:0},iridescence:{value:0},iridescenceMap:{value:null},iridescenceMapTransform:{value:new ae},iridescenceIOR:{value:1.3},iridescenceThicknessMinimum:{value:100},iridescenceThicknessMaximum:{value:400},iridescenceThicknessMap:{value:null},iridescenceThicknessMapTransform:{value:new ae},sheen:{value:0},sheenColor:{value:new ee(0)},sheenColorMap:{value:null},sheenColorMapTransform:{value:new ae},sheenRoughness:{value:1},sheenRoughnessMap:{value:null},sheenRoughnessMapTransform:{value:new ae},transmission:{value:0},transmissionMap:{value:null},transmissionMapTransform:{value:new ae},transmissionSamplerSize:{value:new se},transmissionSamplerMap:{value:null},thickness:{value:0},thicknessMap:{value:null},thicknessMapTransform:{value:new ae},attenuationDistance:{value:0},attenuationColor:{value:new ee(0)},specularColor:{value:new ee(1,1,1)},specularColorMap:{value:null},specularColorMapTransform:{value:new ae},specularIntensity:{value:1},specularIntensityMap:{value:null},specularIntensityMapTransform:{value:new ae},anisotropyVector:{value:new se},anisotropyMap:{value:null},anisotropyMapTransform:{value:new ae}}]),vertexShader:oe.meshphysical_vert,fragmentShader:oe.meshphysical_frag};const na={r:0,b:0,g:0},ys=new bi,Ex=new Ge;function wx(i,t,e,n,s,r,o){const a=new ee(0);let l=r===!0?0:1,c,u,f=null,h=0,_=null;function x(C){let b=C.isScene===!0?C.background:null;return b&&b.isTexture&&(b=(C.backgroundBlurriness>0?e:t).get(b)),b}function M(C){let b=!1;const R=x(C);R===null?d(a,l):R&&R.isColor&&(d(R,1),b=!0);const D=i.xr.getEnvironmentBlendMode();D==="additive"?n.buffers.color.setClear(0,0,0,1,o):D==="alpha-blend"&&n.buffers.color.setClear(0,0,0,0,o),(i.autoClear||b)&&(n.buffers.depth.setTest(!0),n.buffers.depth.setMask(!0),n.buffers.color.setMask(!0),i.clear(i.autoClearColor,i.autoClearDepth,i.autoClearStencil))}function p(C,b){const R=x(b);R&&(R.isCubeTexture||R.mapping===Ha)?(u===void 0&&(u=new sn(new zr(1,1,1),new hs({name:"BackgroundCubeMaterial",uniforms:Dr(yi.backgroundCube.uniforms),vertexShader:yi.backgroundCube.vertexShader,fragmentShader:yi.backgroundCube.fragmentShader,side:Nn,depthTest:!1,depthWrite:!1,fog:!1})),u.geometry.deleteAttribute("normal"),u.geometry.deleteAttribute("uv"),u.onBeforeRender=function(D,A,y){this.matrixWorld.copyPosition(y.matrixWorld)},Object.defineProperty(u.material,"envMap",{get:function(){return this.uniforms.envMap.value}}),s.update(u)),ys.copy(b.backgroundRotation),ys.x*=-1,ys.y*=-1,ys.z*=-1,R.isCubeTexture&&R.isRenderTargetTexture===!1&&(ys.y*=-1,ys.z*=-1),u.material.uniforms.envMap.value=R,u.material.uniforms.flipEnvMap.value=R.isCubeTexture&&R.isRenderTargetTexture===!1?-1:1,u.material.uniforms.backgroundBlurriness.value=b.backgroundBlurriness,u.material.uniforms.backgroundIntensity.value=b.backgroundIntensity,u.material.uniforms.backgroundRotation.value.setFromMatrix4(Ex.makeRotationFromEuler(ys)),u.material.toneMapped=ye.getTransfer(R.colorSpace)!==Oe,(f!==R||h!==R.version||_!==i.toneMapping)&&(u.material.needsUpdate=!0,f=R,h=R.version,_=i.toneMapping),u.layers.enableAll(),C.unshift(u,u.geometry,u.material,0,0,null)):R&&R.isTexture&&(c===void 0&&(c=new sn(new Wa(2,2),new hs({name:"BackgroundMaterial",uniforms:Dr(yi.background.uniforms),vertexShader:yi.background.vertexShader,fragmentShader:yi.background.fragmentShader,side:cs,depthTest:!1,depthWrite:!1,fog:!1})),c.geometry.deleteAttribute("normal"),Object.defineProperty(c.material,"map",{get:function(){return this.uniforms.t2D.value}}),s.update(c)),c.material.uniforms.t2D.value=R,c.material.uniforms.backgroundIntensity.value=b.backgroundIntensity,c.material.toneMapped=ye.getTransfer(R.colorSpace)!==Oe,R.matrixAutoUpdate===!0&&R.updateMatrix(),c.material.uniforms.uvTransform.value.copy(R.matrix),(f!==R||h!==R.version||_!==i.toneMapping)&&(c.material.needsUpdate=!0,f=R,h=R.version,_=i.toneMapping),c.layers.enableAll(),C.unshift(c,c.geometry,c.material,0,0,null))}function d(C,b){C.getRGB(na,ip(i)),n.buffers.color.setClear(na.r,na.g,na.b,b,o)}return{getClearColor:function(){return a},setClearColor:function(C,b=1){a.set(C),l=b,d(a,l)},getClearAlpha:function(){return l},setClearAlpha:function(C){l=C,d(a,l)},render:M,addToRenderList:p}}function bx(i,t){const e=i.getParameter(i.MAX_VERTEX_ATTRIBS),n={},s=h(null);let r=s,o=!1;function a(g,m,E,N,F){let B=!1;const G=f(N,E,m);r!==G&&(r=G,c(r.object)),B=_(g,N,E,F),B&&x(g,N,E,F),F!==null&&t.update(F,i.ELEMENT_ARRAY_BUFFER),(B||o)&&(o=!1,R(g,m,E,N),F!==null&&i.bindBuffer(i.ELEMENT_ARRAY_BUFFER,t.get(F).buffer))}function l(){return i.createVertexArray()}function c(g){return i.bindVertexArray(g)}function u(g){return i.deleteVertexArray(g)}function f(g,m,E){const N=E.wireframe===!0;let F=n[g.id];F===void 0&&(F={},n[g.id]=F);let B=F[m.id];B===void 0&&(B={},F[m.id]=B);let G=B[N];return G===void 0&&(G=h(l()),B[N]=G),G}function h(g){const m=[],E=[],N=[];for(let F=0;F<e;F++)m[F]=0,E[F]=0,N[F]=0;return{geometry:null,program:null,wireframe:!1,newAttributes:m,enabledAttributes:E,attributeDivisors:N,object:g,attributes:{},index:null}}function _(g,m,E,N){const F=r.attributes,B=m.attributes;let G=0;const K=E.getAttributes();for(const Q in K)if(K[Q].location>=0){const ct=F[Q];let gt=B[Q];if(gt===void 0&&(Q==="instanceMatrix"&&g.instanceMatrix&&(gt=g.instanceMatrix),Q==="instanceColor"&&g.instanceColor&&(gt=g.instanceColor)),ct===void 0||ct.attribute!==gt||gt&&ct.data!==gt.data)return!0;G++}return r.attributesNum!==G||r.index!==N}function x(g,m,E,N){const F={},B=m.attributes;let G=0;const K=E.getAttributes();for(const Q in K)if(K[Q].location>=0){let ct=B[Q];ct===void 0&&(Q==="instanceMatrix"&&g.instanceMatrix&&(ct=g.instanceMatrix),Q==="instanceColor"&&g.instanceColor&&(ct=g.instanceColor));const gt={};gt.attribute=ct,ct&&ct.data&&(gt.data=ct.data),F[Q]=gt,G++}r.attributes=F,r.attributesNum=G,r.index=N}function M(){const g=r.newAttributes;for(let m=0,E=g.length;m<E;m++)g[m]=0}function p(g){d(g,0)}function d(g,m){const E=r.newAttributes,N=r.enabledAttributes,F=r.attributeDivisors;E[g]=1,N[g]===0&&(i.enableVertexAttribArray(g),N[g]=1),F[g]!==m&&(i.vertexAttribDivisor(g,m),F[g]=m)}function C(){const g=r.newAttributes,m=r.enabledAttributes;for(let E=0,N=m.length;E<N;E++)m[E]!==g[E]&&(i.disableVertexAttribArray(E),m[E]=0)}function b(g,m,E,N,F,B,G){G===!0?i.vertexAttribIPointer(g,m,E,F,B):i.vertexAttribPointer(g,m,E,N,F,B)}function R(g,m,E,N){M();const F=N.attributes,B=E.getAttributes(),G=m.defaultAttributeValues;for(const K in B){const Q=B[K];if(Q.location>=0){let dt=F[K];if(dt===void 0&&(K==="instanceMatrix"&&g.instanceMatrix&&(dt=g.instanceMatrix),K==="instanceColor"&&g.instanceColor&&(dt=g.instanceColor)),dt!==void 0){const ct=dt.normalized,gt=dt.itemSize,xt=t.get(dt);if(xt===void 0)continue;const Vt=xt.buffer,rt=xt.type,pt=xt.bytesPerElement,Dt=rt===i.INT||rt===i.UNSIGNED_INT||dt.gpuType===_h;if(dt.isInterleavedBufferAttribute){const St=dt.data,Z=St.stride,J=dt.offset;if(St.isInstancedInterleavedBuffer){for(let Y=0;Y<Q.locationSize;Y++)d(Q.location+Y,St.meshPerAttribute);g.isInstancedMesh!==!0&&N._maxInstanceCount===void 0&&(N._maxInstanceCount=St.meshPerAttribute*St.count)}else for(let Y=0;Y<Q.locationSize;Y++)p(Q.location+Y);i.bindBuffer(i.ARRAY_BUFFER,Vt);for(let Y=0;Y<Q.locationSize;Y++)b(Q.location+Y,gt/Q.locationSize,rt,ct,Z*pt,(J+gt/Q.locationSize*Y)*pt,Dt)}else{if(dt.isInstancedBufferAttribute){for(let St=0;St<Q.locationSize;St++)d(Q.location+St,dt.meshPerAttribute);g.isInstancedMesh!==!0&&N._maxInstanceCount===void 0&&(N._maxInstanceCount=dt.meshPerAttribute*dt.count)}else for(let St=0;St<Q.locationSize;St++)p(Q.location+St);i.bindBuffer(i.ARRAY_BUFFER,Vt);for(let St=0;St<Q.locationSize;St++)b(Q.location+St,gt/Q.locationSize,rt,ct,gt*pt,gt/Q.locationSize*St*pt,Dt)}}else if(G!==void 0){const ct=G[K];if(ct!==void 0)switch(ct.length){case 2:i.vertexAttrib2fv(Q.location,ct);break;case 3:i.vertexAttrib3fv(Q.location,ct);break;case 4:i.vertexAttrib4fv(Q.location,ct);break;default:i.vertexAttrib1fv(Q.location,ct)}}}}C()}function D(){P();for(const g in n){const m=n[g];for(const E in m){const N=m[E];for(const F in N)u(N[F].object),delete N[F];delete m[E]}delete n[g]}}function A(g){if(n[g.id]===void 0)return;const m=n[g.id];for(const E in m){const N=m[E];for(const F in N)u(N[F].object),delete N[F];delete m[E]}delete n[g.id]}function y(g){for(const m in n){const E=n[m];if(E[g.id]===void 0)continue;const N=E[g.id];for(const F in N)u(N[F].object),delete N[F];delete E[g.id]}}function P(){O(),o=!0,r!==s&&(r=s,c(r.object))}function O(){s.geometry=null,s.program=null,s.wireframe=!1}return{setup:a,reset:P,resetDefaultState:O,dispose:D,releaseStatesOfGeometry:A,releaseStatesOfProgram:y,initAttributes:M,enableAttribute:p,disableUnusedAttributes:C}}function Tx(i,t,e){let n;function s(c){n=c}function r(c,u){i.drawArrays(n,c,u),e.update(u,n,1)}function o(c,u,f){f!==0&&(i.drawArraysInstanced(n,c,u,f),e.update(u,n,f))}function a(c,u,f){if(f===0)return;t.get("WEBGL_multi_draw").multiDrawArraysWEBGL(n,c,0,u,0,f);let _=0;for(let x=0;x<f;x++)_+=u[x];e.update(_,n,1)}function l(c,u,f,h){if(f===0)return;const _=t.get("WEBGL_multi_draw");if(_===null)for(let x=0;x<c.length;x++)o(c[x],u[x],h[x]);else{_.multiDrawArraysInstancedWEBGL(n,c,0,u,0,h,0,f);let x=0;for(let M=0;M<f;M++)x+=u[M];for(let M=0;M<h.length;M++)e.update(x,n,h[M])}}this.setMode=s,this.render=r,this.renderInstances=o,this.renderMultiDraw=a,this.renderMultiDrawInstances=l}function Ax(i,t,e,n){let s;function r(){if(s!==void 0)return s;if(t.has("EXT_texture_filter_anisotropic")===!0){const y=t.get("EXT_texture_filter_anisotropic");s=i.getParameter(y.MAX_TEXTURE_MAX_ANISOTROPY_EXT)}else s=0;return s}function o(y){return!(y!==ui&&n.convert(y)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_FORMAT))}function a(y){const P=y===wo&&(t.has("EXT_color_buffer_half_float")||t.has("EXT_color_buffer_float"));return!(y!==Hi&&n.convert(y)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_TYPE)&&y!==Oi&&!P)}function l(y){if(y==="highp"){if(i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.HIGH_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.HIGH_FLOAT).precision>0)return"highp";y="mediump"}return y==="mediump"&&i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.MEDIUM_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.MEDIUM_FLOAT).precision>0?"mediump":"lowp"}let c=e.precision!==void 0?e.precision:"highp";const u=l(c);u!==c&&(console.warn("THREE.WebGLRenderer:",c,"not supported, using",u,"instead."),c=u);const f=e.logarithmicDepthBuffer===!0,h=e.reverseDepthBuffer===!0&&t.has("EXT_clip_control");if(h===!0){const y=t.get("EXT_clip_control");y.clipControlEXT(y.LOWER_LEFT_EXT,y.ZERO_TO_ONE_EXT)}const _=i.getParameter(i.MAX_TEXTURE_IMAGE_UNITS),x=i.getParameter(i.MAX_VERTEX_TEXTURE_IMAGE_UNITS),M=i.getParameter(i.MAX_TEXTURE_SIZE),p=i.getParameter(i.MAX_CUBE_MAP_TEXTURE_SIZE),d=i.getParameter(i.MAX_VERTEX_ATTRIBS),C=i.getParameter(i.MAX_VERTEX_UNIFORM_VECTORS),b=i.getParameter(i.MAX_VARYING_VECTORS),R=i.getParameter(i.MAX_FRAGMENT_UNIFORM_VECTORS),D=x>0,A=i.getParameter(i.MAX_SAMPLES);return{isWebGL2:!0,getMaxAnisotropy:r,getMaxPrecision:l,textureFormatReadable:o,textureTypeReadable:a,precision:c,logarithmicDepthBuffer:f,reverseDepthBuffer:h,maxTextures:_,maxVertexTextures:x,maxTextureSize:M,maxCubemapSize:p,maxAttributes:d,maxVertexUniforms:C,maxVaryings:b,maxFragmentUniforms:R,vertexTextures:D,maxSamples:A}}function Rx(i){const t=this;let e=null,n=0,s=!1,r=!1;const o=new Qi,a=new ae,l={value:null,needsUpdate:!1};this.uniform=l,this.numPlanes=0,this.numIntersection=0,this.init=function(f,h){const _=f.length!==0||h||n!==0||s;return s=h,n=f.length,_},this.beginShadows=function(){r=!0,u(null)},this.endShadows=function(){r=!1},this.setGlobalState=function(f,h){e=u(f,h,0)},this.setState=function(f,h,_){const x=f.clippingPlanes,M=f.clipIntersection,p=f.clipShadows,d=i.get(f);if(!s||x===null||x.length===0||r&&!p)r?u(null):c();else{const C=r?0:n,b=C*4;let R=d.clippingState||null;l.value=R,R=u(x,h,b,_);for(let D=0;D!==b;++D)R[D]=e[D];d.clippingState=R,this.numIntersection=M?this.numPlanes:0,this.numPlanes+=C}};function c(){l.value!==e&&(l.value=e,l.needsUpdate=n>0),t.numPlanes=n,t.numIntersection=0}function u(f,h,_,x){const M=f!==null?f.length:0;let p=null;if(M!==0){if(p=l.value,x!==!0||p===null){const d=_+M*4,C=h.matrixWorldInverse;a.getNormalMatrix(C),(p===null||p.length<d)&&(p=new Float32Array(d));for(let b=0,R=_;b!==M;++b,R+=4)o.copy(f[b]).applyMatrix4(C,a),o.normal.toArray(p,R),p[R+3]=o.constant}l.value=p,l.needsUpdate=!0}return t.numPlanes=M,t.numIntersection=0,p}}function Cx(i){let t=new WeakMap;function e(o,a){return a===Sc?o.mapping=Rr:a===Ec&&(o.mapping=Cr),o}function n(o){if(o&&o.isTexture){const a=o.mapping;if(a===Sc||a===Ec)if(t.has(o)){const l=t.get(o).texture;return e(l,o.mapping)}else{const l=o.image;if(l&&l.height>0){const c=new z_(l.height);return c.fromEquirectangularTexture(i,o),t.set(o,c),o.addEventListener("dispose",s),e(c.texture,o.mapping)}else return null}}return o}function s(o){const a=o.target;a.removeEventListener("dispose",s);const l=t.get(a);l!==void 0&&(t.delete(a),l.dispose())}function r(){t=new WeakMap}return{get:n,dispose:r}}class ap extends sp{constructor(t=-1,e=1,n=1,s=-1,r=.1,o=2e3){super(),this.isOrthographicCamera=!0,this.type="OrthographicCamera",this.zoom=1,this.view=null,this.left=t,this.right=e,this.top=n,this.bottom=s,this.near=r,this.far=o,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.left=t.left,this.right=t.right,this.top=t.top,this.bottom=t.bottom,this.near=t.near,this.far=t.far,this.zoom=t.zoom,this.view=t.view===null?null:Object.assign({},t.view),this}setViewOffset(t,e,n,s,r,o){this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=n,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){const t=(this.right-this.left)/(2*this.zoom),e=(this.top-this.bottom)/(2*this.zoom),n=(this.right+this.left)/2,s=(this.top+this.bottom)/2;let r=n-t,o=n+t,a=s+e,l=s-e;if(this.view!==null&&this.view.enabled){const c=(this.right-this.left)/this.view.fullWidth/this.zoom,u=(this.top-this.bottom)/this.view.fullHeight/this.zoom;r+=c*this.view.offsetX,o=r+c*this.view.width,a-=u*this.view.offsetY,l=a-u*this.view.height}this.projectionMatrix.makeOrthographic(r,o,a,l,this.near,this.far,this.coordinateSystem),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){const e=super.toJSON(t);return e.object.zoom=this.zoom,e.object.left=this.left,e.object.right=this.right,e.object.top=this.top,e.object.bottom=this.bottom,e.object.near=this.near,e.object.far=this.far,this.view!==null&&(e.object.view=Object.assign({},this.view)),e}}const xr=4,ju=[.125,.215,.35,.446,.526,.582],As=20,zl=new ap,Ku=new ee;let Hl=null,Gl=0,Vl=0,Wl=!1;const Es=(1+Math.sqrt(5))/2,dr=1/Es,$u=[new $(-Es,dr,0),new $(Es,dr,0),new $(-dr,0,Es),new $(dr,0,Es),new $(0,Es,-dr),new $(0,Es,dr),new $(-1,1,-1),new $(1,1,-1),new $(-1,1,1),new $(1,1,1)];class Zu{constructor(t){this._renderer=t,this._pingPongRenderTarget=null,this._lodMax=0,this._cubeSize=0,this._lodPlanes=[],this._sizeLods=[],this._sigmas=[],this._blurMaterial=null,this._cubemapMaterial=null,this._equirectMaterial=null,this._compileMaterial(this._blurMaterial)}fromScene(t,e=0,n=.1,s=100){Hl=this._renderer.getRenderTarget(),Gl=this._renderer.getActiveCubeFace(),Vl=this._renderer.getActiveMipmapLevel(),Wl=this._renderer.xr.enabled,this._renderer.xr.enabled=!1,this._setSize(256);const r=this._allocateTargets();return r.depthBuffer=!0,this._sceneToCubeUV(t,n,s,r),e>0&&this._blur(r,0,0,e),this._applyPMREM(r),this._cleanup(r),r}fromEquirectangular(t,e=null){return this._fromTexture(t,e)}fromCubemap(t,e=null){return this._fromTexture(t,e)}compileCubemapShader(){this._cubemapMaterial===null&&(this._cubemapMaterial=tf(),this._compileMaterial(this._cubemapMaterial))}compileEquirectangularShader(){this._equirectMaterial===null&&(this._equirectMaterial=Qu(),this._compileMaterial(this._equirectMaterial))}dispose(){this._dispose(),this._cubemapMaterial!==null&&this._cubemapMaterial.dispose(),this._equirectMaterial!==null&&this._equirectMaterial.dispose()}_setSize(t){this._lodMax=Math.floor(Math.log2(t)),this._cubeSize=Math.pow(2,this._lodMax)}_dispose(){this._blurMaterial!==null&&this._blurMaterial.dispose(),this._pingPongRenderTarget!==null&&this._pingPongRenderTarget.dispose();for(let t=0;t<this._lodPlanes.length;t++)this._lodPlanes[t].dispose()}_cleanup(t){this._renderer.setRenderTarget(Hl,Gl,Vl),this._renderer.xr.enabled=Wl,t.scissorTest=!1,ia(t,0,0,t.width,t.height)}_fromTexture(t,e){t.mapping===Rr||t.mapping===Cr?this._setSize(t.image.length===0?16:t.image[0].width||t.image[0].image.width):this._setSize(t.image.width/4),Hl=this._renderer.getRenderTarget(),Gl=this._renderer.getActiveCubeFace(),Vl=this._renderer.getActiveMipmapLevel(),Wl=this._renderer.xr.enabled,this._renderer.xr.enabled=!1;const n=e||this._allocateTargets();return this._textureToCubeUV(t,n),this._applyPMREM(n),this._cleanup(n),n}_allocateTargets(){const t=3*Math.max(this._cubeSize,112),e=4*this._cubeSize,n={magFilter:hi,minFilter:hi,generateMipmaps:!1,type:wo,format:ui,colorSpace:fs,depthBuffer:!1},s=Ju(t,e,n);if(this._pingPongRenderTarget===null||this._pingPongRenderTarget.width!==t||this._pingPongRenderTarget.height!==e){this._pingPongRenderTarget!==null&&this._dispose(),this._pingPongRenderTarget=Ju(t,e,n);const{_lodMax:r}=this;({sizeLods:this._sizeLods,lodPlanes:this._lodPlanes,sigmas:this._sigmas}=Px(r)),this._blurMaterial=Lx(r,t,e)}return s}_compileMaterial(t){const e=new sn(this._lodPlanes[0],t);this._renderer.compile(e,zl)}_sceneToCubeUV(t,e,n,s){const a=new $n(90,1,e,n),l=[1,-1,1,1,1,1],c=[1,1,1,-1,-1,-1],u=this._renderer,f=u.autoClear,h=u.toneMapping;u.getClearColor(Ku),u.toneMapping=as,u.autoClear=!1;const _=new Br({name:"PMREM.Background",side:Nn,depthWrite:!1,depthTest:!1}),x=new sn(new zr,_);let M=!1;const p=t.background;p?p.isColor&&(_.color.copy(p),t.background=null,M=!0):(_.color.copy(Ku),M=!0);for(let d=0;d<6;d++){const C=d%3;C===0?(a.up.set(0,l[d],0),a.lookAt(c[d],0,0)):C===1?(a.up.set(0,0,l[d]),a.lookAt(0,c[d],0)):(a.up.set(0,l[d],0),a.lookAt(0,0,c[d]));const b=this._cubeSize;ia(s,C*b,d>2?b:0,b,b),u.setRenderTarget(s),M&&u.render(x,a),u.render(t,a)}x.geometry.dispose(),x.material.dispose(),u.toneMapping=h,u.autoClear=f,t.background=p}_textureToCubeUV(t,e){const n=this._renderer,s=t.mapping===Rr||t.mapping===Cr;s?(this._cubemapMaterial===null&&(this._cubemapMaterial=tf()),this._cubemapMaterial.uniforms.flipEnvMap.value=t.isRenderTargetTexture===!1?-1:1):this._equirectMaterial===null&&(this._equirectMaterial=Qu());const r=s?this._cubemapMaterial:this._equirectMaterial,o=new sn(this._lodPlanes[0],r),a=r.uniforms;a.envMap.value=t;const l=this._cubeSize;ia(e,0,0,3*l,2*l),n.setRenderTarget(e),n.render(o,zl)}_applyPMREM(t){const e=this._renderer,n=e.autoClear;e.autoClear=!1;const s=this._lodPlanes.length;for(let r=1;r<s;r++){const o=Math.sqrt(this._sigmas[r]*this._sigmas[r]-this._sigmas[r-1]*this._sigmas[r-1]),a=$u[(s-r-1)%$u.length];this._blur(t,r-1,r,o,a)}e.autoClear=n}_blur(t,e,n,s,r){const o=this._pingPongRenderTarget;this._halfBlur(t,o,e,n,s,"latitudinal",r),this._halfBlur(o,t,n,n,s,"longitudinal",r)}_halfBlur(t,e,n,s,r,o,a){const l=this._renderer,c=this._blurMaterial;o!=="latitudinal"&&o!=="longitudinal"&&console.error("blur direction must be either latitudinal or longitudinal!");const u=3,f=new sn(this._lodPlanes[s],c),h=c.uniforms,_=this._sizeLods[n]-1,x=isFinite(r)?Math.PI/(2*_):2*Math.PI/(2*As-1),M=r/x,p=isFinite(r)?1+Math.floor(u*M):As;p>As&&console.warn(`sigmaRadians, ${r}, is too large and will clip, as it requested ${p} samples when the maximum is set to ${As}`);const d=[];let C=0;for(let y=0;y<As;++y){const P=y/M,O=Math.exp(-P*P/2);d.push(O),y===0?C+=O:y<p&&(C+=2*O)}for(let y=0;y<d.length;y++)d[y]=d[y]/C;h.envMap.value=t.texture,h.samples.value=p,h.weights.value=d,h.latitudinal.value=o==="latitudinal",a&&(h.poleAxis.value=a);const{_lodMax:b}=this;h.dTheta.value=x,h.mipInt.value=b-n;const R=this._sizeLods[s],D=3*R*(s>b-xr?s-b+xr:0),A=4*(this._cubeSize-R);ia(e,D,A,3*R,2*R),l.setRenderTarget(e),l.render(f,zl)}}function Px(i){const t=[],e=[],n=[];let s=i;const r=i-xr+1+ju.length;for(let o=0;o<r;o++){const a=Math.pow(2,s);e.push(a);let l=1/a;o>i-xr?l=ju[o-i+xr-1]:o===0&&(l=0),n.push(l);const c=1/(a-2),u=-c,f=1+c,h=[u,u,f,u,f,f,u,u,f,f,u,f],_=6,x=6,M=3,p=2,d=1,C=new Float32Array(M*x*_),b=new Float32Array(p*x*_),R=new Float32Array(d*x*_);for(let A=0;A<_;A++){const y=A%3*2/3-1,P=A>2?0:-1,O=[y,P,0,y+2/3,P,0,y+2/3,P+1,0,y,P,0,y+2/3,P+1,0,y,P+1,0];C.set(O,M*x*A),b.set(h,p*x*A);const g=[A,A,A,A,A,A];R.set(g,d*x*A)}const D=new Sn;D.setAttribute("position",new ei(C,M)),D.setAttribute("uv",new ei(b,p)),D.setAttribute("faceIndex",new ei(R,d)),t.push(D),s>xr&&s--}return{lodPlanes:t,sizeLods:e,sigmas:n}}function Ju(i,t,e){const n=new ks(i,t,e);return n.texture.mapping=Ha,n.texture.name="PMREM.cubeUv",n.scissorTest=!0,n}function ia(i,t,e,n,s){i.viewport.set(t,e,n,s),i.scissor.set(t,e,n,s)}function Lx(i,t,e){const n=new Float32Array(As),s=new $(0,1,0);return new hs({name:"SphericalGaussianBlur",defines:{n:As,CUBEUV_TEXEL_WIDTH:1/t,CUBEUV_TEXEL_HEIGHT:1/e,CUBEUV_MAX_MIP:`${i}.0`},uniforms:{envMap:{value:null},samples:{value:1},weights:{value:n},latitudinal:{value:!1},dTheta:{value:0},mipInt:{value:0},poleAxis:{value:s}},vertexShader:Th(),fragmentShader:`

			precision mediump float;
			precision mediump int;

			varying vec3 vOutputDirection;

			uniform sampler2D envMap;
			uniform int samples;
			uniform float weights[ n ];
			uniform bool latitudinal;
			uniform float dTheta;
			uniform float mipInt;
			uniform vec3 poleAxis;

			#define ENVMAP_TYPE_CUBE_UV
			#include <cube_uv_reflection_fragment>

			vec3 getSample( float theta, vec3 axis ) {

				float cosTheta = cos( theta );
				// Rodrigues' axis-angle rotation
				vec3 sampleDirection = vOutputDirection * cosTheta
					+ cross( axis, vOutputDirection ) * sin( theta )
					+ axis * dot( axis, vOutputDirection ) * ( 1.0 - cosTheta );

				return bilinearCubeUV( envMap, sampleDirection, mipInt );

			}

			void main() {

				vec3 axis = latitudinal ? poleAxis : cross( poleAxis, vOutputDirection );

				if ( all( equal( axis, vec3( 0.0 ) ) ) ) {

					axis = vec3( vOutputDirection.z, 0.0, - vOutputDirection.x );

				}

				axis = normalize( axis );

				gl_FragColor = vec4( 0.0, 0.0, 0.0, 1.0 );
				gl_FragColor.rgb += weights[ 0 ] * getSample( 0.0, axis );

				for ( int i = 1; i < n; i++ ) {

					if ( i >= samples ) {

						break;

					}

					float theta = dTheta * float( i );
					gl_FragColor.rgb += weights[ i ] * getSample( -1.0 * theta, axis );
					gl_FragColor.rgb += weights[ i ] * getSample( theta, axis );

				}

			}
		`,blending:os,depthTest:!1,depthWrite:!1})}function Qu(){return new hs({name:"EquirectangularToCubeUV",uniforms:{envMap:{value:null}},vertexShader:Th(),fragmentShader:`

			precision mediump float;
			precision mediump int;

			varying vec3 vOutputDirection;

			uniform sampler2D envMap;

			#include <common>

			void main() {

				vec3 outputDirection = normalize( vOutputDirection );
				vec2 uv = equirectUv( outputDirection );

				gl_FragColor = vec4( texture2D ( envMap, uv ).rgb, 1.0 );

			}
		`,blending:os,depthTest:!1,depthWrite:!1})}function tf(){return new hs({name:"CubemapToCubeUV",uniforms:{envMap:{value:null},flipEnvMap:{value:-1}},vertexShader:Th(),fragmentShader:`

			precision mediump float;
			precision mediump int;

			uniform float flipEnvMap;

			varying vec3 vOutputDirection;

			uniform samplerCube envMap;

			void main() {

				gl_FragColor = textureCube( envMap, vec3( flipEnvMap * vOutputDirection.x, vOutputDirection.yz ) );

			}
		`,blending:os,depthTest:!1,depthWrite:!1})}function Th(){return`

		precision mediump float;
		precision mediump int;

		attribute float faceIndex;

		varying vec3 vOutputDirection;

		// RH coordinate system; PMREM face-indexing convention
		vec3 getDirection( vec2 uv, float face ) {

			uv = 2.0 * uv - 1.0;

			vec3 direction = vec3( uv, 1.0 );

			if ( face == 0.0 ) {

				direction = direction.zyx; // ( 1, v, u ) pos x

			} else if ( face == 1.0 ) {

				direction = direction.xzy;
				direction.xz *= -1.0; // ( -u, 1, -v ) pos y

			} else if ( face == 2.0 ) {

				direction.x *= -1.0; // ( -u, v, 1 ) pos z

			} else if ( face == 3.0 ) {

				direction = direction.zyx;
				direction.xz *= -1.0; // ( -1, v, -u ) neg x

			} else if ( face == 4.0 ) {

				direction = direction.xzy;
				direction.xy *= -1.0; // ( -u, -1, v ) neg y

			} else if ( face == 5.0 ) {

				direction.z *= -1.0; // ( u, v, -1 ) neg z

			}

			return direction;

		}

		void main() {

			vOutputDirection = getDirection( uv, faceIndex );
			gl_Position = vec4( position, 1.0 );

		}
	`}function Dx(i){let t=new WeakMap,e=null;function n(a){if(a&&a.isTexture){const l=a.mapping,c=l===Sc||l===Ec,u=l===Rr||l===Cr;if(c||u){let f=t.get(a);const h=f!==void 0?f.texture.pmremVersion:0;if(a.isRenderTargetTexture&&a.pmremVersion!==h)return e===null&&(e=new Zu(i)),f=c?e.fromEquirectangular(a,f):e.fromCubemap(a,f),f.texture.pmremVersion=a.pmremVersion,t.set(a,f),f.texture;if(f!==void 0)return f.texture;{const _=a.image;return c&&_&&_.height>0||u&&_&&s(_)?(e===null&&(e=new Zu(i)),f=c?e.fromEquirectangular(a):e.fromCubemap(a),f.texture.pmremVersion=a.pmremVersion,t.set(a,f),a.addEventListener("dispose",r),f.texture):null}}}return a}function s(a){let l=0;const c=6;for(let u=0;u<c;u++)a[u]!==void 0&&l++;return l===c}function r(a){const l=a.target;l.removeEventListener("dispose",r);const c=t.get(l);c!==void 0&&(t.delete(l),c.dispose())}function o(){t=new WeakMap,e!==null&&(e.dispose(),e=null)}return{get:n,dispose:o}}function Ix(i){const t={};function e(n){if(t[n]!==void 0)return t[n];let s;switch(n){case"WEBGL_depth_texture":s=i.getExtension("WEBGL_depth_texture")||i.getExtension("MOZ_WEBGL_depth_texture")||i.getExtension("WEBKIT_WEBGL_depth_texture");break;case"EXT_texture_filter_anisotropic":s=i.getExtension("EXT_texture_filter_anisotropic")||i.getExtension("MOZ_EXT_texture_filter_anisotropic")||i.getExtension("WEBKIT_EXT_texture_filter_anisotropic");break;case"WEBGL_compressed_texture_s3tc":s=i.getExtension("WEBGL_compressed_texture_s3tc")||i.getExtension("MOZ_WEBGL_compressed_texture_s3tc")||i.getExtension("WEBKIT_WEBGL_compressed_texture_s3tc");break;case"WEBGL_compressed_texture_pvrtc":s=i.getExtension("WEBGL_compressed_texture_pvrtc")||i.getExtension("WEBKIT_WEBGL_compressed_texture_pvrtc");break;default:s=i.getExtension(n)}return t[n]=s,s}return{has:function(n){return e(n)!==null},init:function(){e("EXT_color_buffer_float"),e("WEBGL_clip_cull_distance"),e("OES_texture_float_linear"),e("EXT_color_buffer_half_float"),e("WEBGL_multisampled_render_to_texture"),e("WEBGL_render_shared_exponent")},get:function(n){const s=e(n);return s===null&&wa("THREE.WebGLRenderer: "+n+" extension not supported."),s}}}function Ux(i,t,e,n){const s={},r=new WeakMap;function o(f){const h=f.target;h.index!==null&&t.remove(h.index);for(const x in h.attributes)t.remove(h.attributes[x]);for(const x in h.morphAttributes){const M=h.morphAttributes[x];for(let p=0,d=M.length;p<d;p++)t.remove(M[p])}h.removeEventListener("dispose",o),delete s[h.id];const _=r.get(h);_&&(t.remove(_),r.delete(h)),n.releaseStatesOfGeometry(h),h.isInstancedBufferGeometry===!0&&delete h._maxInstanceCount,e.memory.geometries--}function a(f,h){return s[h.id]===!0||(h.addEventListener("dispose",o),s[h.id]=!0,e.memory.geometries++),h}function l(f){const h=f.attributes;for(const x in h)t.update(h[x],i.ARRAY_BUFFER);const _=f.morphAttributes;for(const x in _){const M=_[x];for(let p=0,d=M.length;p<d;p++)t.update(M[p],i.ARRAY_BUFFER)}}function c(f){const h=[],_=f.index,x=f.attributes.position;let M=0;if(_!==null){const C=_.array;M=_.version;for(let b=0,R=C.length;b<R;b+=3){const D=C[b+0],A=C[b+1],y=C[b+2];h.push(D,A,A,y,y,D)}}else if(x!==void 0){const C=x.array;M=x.version;for(let b=0,R=C.length/3-1;b<R;b+=3){const D=b+0,A=b+1,y=b+2;h.push(D,A,A,y,y,D)}}else return;const p=new($d(h)?np:ep)(h,1);p.version=M;const d=r.get(f);d&&t.remove(d),r.set(f,p)}function u(f){const h=r.get(f);if(h){const _=f.index;_!==null&&h.version<_.version&&c(f)}else c(f);return r.get(f)}return{get:a,update:l,getWireframeAttribute:u}}function Nx(i,t,e){let n;function s(h){n=h}let r,o;function a(h){r=h.type,o=h.bytesPerElement}function l(h,_){i.drawElements(n,_,r,h*o),e.update(_,n,1)}function c(h,_,x){x!==0&&(i.drawElementsInstanced(n,_,r,h*o,x),e.update(_,n,x))}function u(h,_,x){if(x===0)return;t.get("WEBGL_multi_draw").multiDrawElementsWEBGL(n,_,0,r,h,0,x);let p=0;for(let d=0;d<x;d++)p+=_[d];e.update(p,n,1)}function f(h,_,x,M){if(x===0)return;const p=t.get("WEBGL_multi_draw");if(p===null)for(let d=0;d<h.length;d++)c(h[d]/o,_[d],M[d]);else{p.multiDrawElementsInstancedWEBGL(n,_,0,r,h,0,M,0,x);let d=0;for(let C=0;C<x;C++)d+=_[C];for(let C=0;C<M.length;C++)e.update(d,n,M[C])}}this.setMode=s,this.setIndex=a,this.render=l,this.renderInstances=c,this.renderMultiDraw=u,this.renderMultiDrawInstances=f}function kx(i){const t={geometries:0,textures:0},e={frame:0,calls:0,triangles:0,points:0,lines:0};function n(r,o,a){switch(e.calls++,o){case i.TRIANGLES:e.triangles+=a*(r/3);break;case i.LINES:e.lines+=a*(r/2);break;case i.LINE_STRIP:e.lines+=a*(r-1);break;case i.LINE_LOOP:e.lines+=a*r;break;case i.POINTS:e.points+=a*r;break;default:console.error("THREE.WebGLInfo: Unknown draw mode:",o);break}}function s(){e.calls=0,e.triangles=0,e.points=0,e.lines=0}return{memory:t,render:e,programs:null,autoReset:!0,reset:s,update:n}}function Ox(i,t,e){const n=new WeakMap,s=new Ye;function r(o,a,l){const c=o.morphTargetInfluences,u=a.morphAttributes.position||a.morphAttributes.normal||a.morphAttributes.color,f=u!==void 0?u.length:0;let h=n.get(a);if(h===void 0||h.count!==f){let g=function(){P.dispose(),n.delete(a),a.removeEventListener("dispose",g)};var _=g;h!==void 0&&h.texture.dispose();const x=a.morphAttributes.position!==void 0,M=a.morphAttributes.normal!==void 0,p=a.morphAttributes.color!==void 0,d=a.morphAttributes.position||[],C=a.morphAttributes.normal||[],b=a.morphAttributes.color||[];let R=0;x===!0&&(R=1),M===!0&&(R=2),p===!0&&(R=3);let D=a.attributes.position.count*R,A=1;D>t.maxTextureSize&&(A=Math.ceil(D/t.maxTextureSize),D=t.maxTextureSize);const y=new Float32Array(D*A*4*f),P=new Jd(y,D,A,f);P.type=Oi,P.needsUpdate=!0;const O=R*4;for(let m=0;m<f;m++){const E=d[m],N=C[m],F=b[m],B=D*A*4*m;for(let G=0;G<E.count;G++){const K=G*O;x===!0&&(s.fromBufferAttribute(E,G),y[B+K+0]=s.x,y[B+K+1]=s.y,y[B+K+2]=s.z,y[B+K+3]=0),M===!0&&(s.fromBufferAttribute(N,G),y[B+K+4]=s.x,y[B+K+5]=s.y,y[B+K+6]=s.z,y[B+K+7]=0),p===!0&&(s.fromBufferAttribute(F,G),y[B+K+8]=s.x,y[B+K+9]=s.y,y[B+K+10]=s.z,y[B+K+11]=F.itemSize===4?s.w:1)}}h={count:f,texture:P,size:new se(D,A)},n.set(a,h),a.addEventListener("dispose",g)}if(o.isInstancedMesh===!0&&o.morphTexture!==null)l.getUniforms().setValue(i,"morphTexture",o.morphTexture,e);else{let x=0;for(let p=0;p<c.length;p++)x+=c[p];const M=a.morphTargetsRelative?1:1-x;l.getUniforms().setValue(i,"morphTargetBaseInfluence",M),l.getUniforms().setValue(i,"morphTargetInfluences",c)}l.getUniforms().setValue(i,"morphTargetsTexture",h.texture,e),l.getUniforms().setValue(i,"morphTargetsTextureSize",h.size)}return{update:r}}function Fx(i,t,e,n){let s=new WeakMap;function r(l){const c=n.render.frame,u=l.geometry,f=t.get(l,u);if(s.get(f)!==c&&(t.update(f),s.set(f,c)),l.isInstancedMesh&&(l.hasEventListener("dispose",a)===!1&&l.addEventListener("dispose",a),s.get(l)!==c&&(e.update(l.instanceMatrix,i.ARRAY_BUFFER),l.instanceColor!==null&&e.update(l.instanceColor,i.ARRAY_BUFFER),s.set(l,c))),l.isSkinnedMesh){const h=l.skeleton;s.get(h)!==c&&(h.update(),s.set(h,c))}return f}function o(){s=new WeakMap}function a(l){const c=l.target;c.removeEventListener("dispose",a),e.remove(c.instanceMatrix),c.instanceColor!==null&&e.remove(c.instanceColor)}return{update:r,dispose:o}}class lp extends kn{constructor(t,e,n,s,r,o,a,l,c,u=wr){if(u!==wr&&u!==Lr)throw new Error("DepthTexture format must be either THREE.DepthFormat or THREE.DepthStencilFormat");n===void 0&&u===wr&&(n=Ns),n===void 0&&u===Lr&&(n=Pr),super(null,s,r,o,a,l,u,n,c),this.isDepthTexture=!0,this.image={width:t,height:e},this.magFilter=a!==void 0?a:Qn,this.minFilter=l!==void 0?l:Qn,this.flipY=!1,this.generateMipmaps=!1,this.compareFunction=null}copy(t){return super.copy(t),this.compareFunction=t.compareFunction,this}toJSON(t){const e=super.toJSON(t);return this.compareFunction!==null&&(e.compareFunction=this.compareFunction),e}}const cp=new kn,ef=new lp(1,1),hp=new Jd,up=new w_,fp=new rp,nf=[],sf=[],rf=new Float32Array(16),of=new Float32Array(9),af=new Float32Array(4);function Hr(i,t,e){const n=i[0];if(n<=0||n>0)return i;const s=t*e;let r=nf[s];if(r===void 0&&(r=new Float32Array(s),nf[s]=r),t!==0){n.toArray(r,0);for(let o=1,a=0;o!==t;++o)a+=e,i[o].toArray(r,a)}return r}function rn(i,t){if(i.length!==t.length)return!1;for(let e=0,n=i.length;e<n;e++)if(i[e]!==t[e])return!1;return!0}function on(i,t){for(let e=0,n=t.length;e<n;e++)i[e]=t[e]}function Xa(i,t){let e=sf[t];e===void 0&&(e=new Int32Array(t),sf[t]=e);for(let n=0;n!==t;++n)e[n]=i.allocateTextureUnit();return e}function Bx(i,t){const e=this.cache;e[0]!==t&&(i.uniform1f(this.addr,t),e[0]=t)}function zx(i,t){const e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(i.uniform2f(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(rn(e,t))return;i.uniform2fv(this.addr,t),on(e,t)}}function Hx(i,t){const e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(i.uniform3f(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else if(t.r!==void 0)(e[0]!==t.r||e[1]!==t.g||e[2]!==t.b)&&(i.uniform3f(this.addr,t.r,t.g,t.b),e[0]=t.r,e[1]=t.g,e[2]=t.b);else{if(rn(e,t))return;i.uniform3fv(this.addr,t),on(e,t)}}function Gx(i,t){const e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(i.uniform4f(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(rn(e,t))return;i.uniform4fv(this.addr,t),on(e,t)}}function Vx(i,t){const e=this.cache,n=t.elements;if(n===void 0){if(rn(e,t))return;i.uniformMatrix2fv(this.addr,!1,t),on(e,t)}else{if(rn(e,n))return;af.set(n),i.uniformMatrix2fv(this.addr,!1,af),on(e,n)}}function Wx(i,t){const e=this.cache,n=t.elements;if(n===void 0){if(rn(e,t))return;i.uniformMatrix3fv(this.addr,!1,t),on(e,t)}else{if(rn(e,n))return;of.set(n),i.uniformMatrix3fv(this.addr,!1,of),on(e,n)}}function Xx(i,t){const e=this.cache,n=t.elements;if(n===void 0){if(rn(e,t))return;i.uniformMatrix4fv(this.addr,!1,t),on(e,t)}else{if(rn(e,n))return;rf.set(n),i.uniformMatrix4fv(this.addr,!1,rf),on(e,n)}}function qx(i,t){const e=this.cache;e[0]!==t&&(i.uniform1i(this.addr,t),e[0]=t)}function Yx(i,t){const e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(i.uniform2i(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(rn(e,t))return;i.uniform2iv(this.addr,t),on(e,t)}}function jx(i,t){const e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(i.uniform3i(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(rn(e,t))return;i.uniform3iv(this.addr,t),on(e,t)}}function Kx(i,t){const e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(i.uniform4i(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(rn(e,t))return;i.uniform4iv(this.addr,t),on(e,t)}}function $x(i,t){const e=this.cache;e[0]!==t&&(i.uniform1ui(this.addr,t),e[0]=t)}function Zx(i,t){const e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(i.uniform2ui(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(rn(e,t))return;i.uniform2uiv(this.addr,t),on(e,t)}}function Jx(i,t){const e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(i.uniform3ui(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(rn(e,t))return;i.uniform3uiv(this.addr,t),on(e,t)}}function Qx(i,t){const e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(i.uniform4ui(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(rn(e,t))return;i.uniform4uiv(this.addr,t),on(e,t)}}function tM(i,t,e){const n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s);let r;this.type===i.SAMPLER_2D_SHADOW?(ef.compareFunction=Kd,r=ef):r=cp,e.setTexture2D(t||r,s)}function eM(i,t,e){const n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),e.setTexture3D(t||up,s)}function nM(i,t,e){const n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),e.setTextureCube(t||fp,s)}function iM(i,t,e){const n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),e.setTexture2DArray(t||hp,s)}function sM(i){switch(i){case 5126:return Bx;case 35664:return zx;case 35665:return Hx;case 35666:return Gx;case 35674:return Vx;case 35675:return Wx;case 35676:return Xx;case 5124:case 35670:return qx;case 35667:case 35671:return Yx;case 35668:case 35672:return jx;case 35669:case 35673:return Kx;case 5125:return $x;case 36294:return Zx;case 36295:return Jx;case 36296:return Qx;case 35678:case 36198:case 36298:case 36306:case 35682:return tM;case 35679:case 36299:case 36307:return eM;case 35680:case 36300:case 36308:case 36293:return nM;case 36289:case 36303:case 36311:case 36292:return iM}}function rM(i,t){i.uniform1fv(this.addr,t)}function oM(i,t){const e=Hr(t,this.size,2);i.uniform2fv(this.addr,e)}function aM(i,t){const e=Hr(t,this.size,3);i.uniform3fv(this.addr,e)}function lM(i,t){const e=Hr(t,this.size,4);i.uniform4fv(this.addr,e)}function cM(i,t){const e=Hr(t,this.size,4);i.uniformMatrix2fv(this.addr,!1,e)}function hM(i,t){const e=Hr(t,this.size,9);i.uniformMatrix3fv(this.addr,!1,e)}function uM(i,t){const e=Hr(t,this.size,16);i.uniformMatrix4fv(this.addr,!1,e)}function fM(i,t){i.uniform1iv(this.addr,t)}function dM(i,t){i.uniform2iv(this.addr,t)}function pM(i,t){i.uniform3iv(this.addr,t)}function mM(i,t){i.uniform4iv(this.addr,t)}function gM(i,t){i.uniform1uiv(this.addr,t)}function _M(i,t){i.uniform2uiv(this.addr,t)}function vM(i,t){i.uniform3uiv(this.addr,t)}function xM(i,t){i.uniform4uiv(this.addr,t)}function MM(i,t,e){const n=this.cache,s=t.length,r=Xa(e,s);rn(n,r)||(i.uniform1iv(this.addr,r),on(n,r));for(let o=0;o!==s;++o)e.setTexture2D(t[o]||cp,r[o])}function yM(i,t,e){const n=this.cache,s=t.length,r=Xa(e,s);rn(n,r)||(i.uniform1iv(this.addr,r),on(n,r));for(let o=0;o!==s;++o)e.setTexture3D(t[o]||up,r[o])}function SM(i,t,e){const n=this.cache,s=t.length,r=Xa(e,s);rn(n,r)||(i.uniform1iv(this.addr,r),on(n,r));for(let o=0;o!==s;++o)e.setTextureCube(t[o]||fp,r[o])}function EM(i,t,e){const n=this.cache,s=t.length,r=Xa(e,s);rn(n,r)||(i.uniform1iv(this.addr,r),on(n,r));for(let o=0;o!==s;++o)e.setTexture2DArray(t[o]||hp,r[o])}function wM(i){switch(i){case 5126:return rM;case 35664:return oM;case 35665:return aM;case 35666:return lM;case 35674:return cM;case 35675:return hM;case 35676:return uM;case 5124:case 35670:return fM;case 35667:case 35671:return dM;case 35668:case 35672:return pM;case 35669:case 35673:return mM;case 5125:return gM;case 36294:return _M;case 36295:return vM;case 36296:return xM;case 35678:case 36198:case 36298:case 36306:case 35682:return MM;case 35679:case 36299:case 36307:return yM;case 35680:case 36300:case 36308:case 36293:return SM;case 36289:case 36303:case 36311:case 36292:return EM}}class bM{constructor(t,e,n){this.id=t,this.addr=n,this.cache=[],this.type=e.type,this.setValue=sM(e.type)}}class TM{constructor(t,e,n){this.id=t,this.addr=n,this.cache=[],this.type=e.type,this.size=e.size,this.setValue=wM(e.type)}}class AM{constructor(t){this.id=t,this.seq=[],this.map={}}setValue(t,e,n){const s=this.seq;for(let r=0,o=s.length;r!==o;++r){const a=s[r];a.setValue(t,e[a.id],n)}}}const Xl=/(\w+)(\])?(\[|\.)?/g;function lf(i,t){i.seq.push(t),i.map[t.id]=t}function RM(i,t,e){const n=i.name,s=n.length;for(Xl.lastIndex=0;;){const r=Xl.exec(n),o=Xl.lastIndex;let a=r[1];const l=r[2]==="]",c=r[3];if(l&&(a=a|0),c===void 0||c==="["&&o+2===s){lf(e,c===void 0?new bM(a,i,t):new TM(a,i,t));break}else{let f=e.map[a];f===void 0&&(f=new AM(a),lf(e,f)),e=f}}}class ba{constructor(t,e){this.seq=[],this.map={};const n=t.getProgramParameter(e,t.ACTIVE_UNIFORMS);for(let s=0;s<n;++s){const r=t.getActiveUniform(e,s),o=t.getUniformLocation(e,r.name);RM(r,o,this)}}setValue(t,e,n,s){const r=this.map[e];r!==void 0&&r.setValue(t,n,s)}setOptional(t,e,n){const s=e[n];s!==void 0&&this.setValue(t,n,s)}static upload(t,e,n,s){for(let r=0,o=e.length;r!==o;++r){const a=e[r],l=n[a.id];l.needsUpdate!==!1&&a.setValue(t,l.value,s)}}static seqWithValue(t,e){const n=[];for(let s=0,r=t.length;s!==r;++s){const o=t[s];o.id in e&&n.push(o)}return n}}function cf(i,t,e){const n=i.createShader(t);return i.shaderSource(n,e),i.compileShader(n),n}const CM=37297;let PM=0;function LM(i,t){const e=i.split(`
`),n=[],s=Math.max(t-6,0),r=Math.min(t+6,e.length);for(let o=s;o<r;o++){const a=o+1;n.push(`${a===t?">":" "} ${a}: ${e[o]}`)}return n.join(`
`)}function DM(i){const t=ye.getPrimaries(ye.workingColorSpace),e=ye.getPrimaries(i);let n;switch(t===e?n="":t===Da&&e===La?n="LinearDisplayP3ToLinearSRGB":t===La&&e===Da&&(n="LinearSRGBToLinearDisplayP3"),i){case fs:case Ga:return[n,"LinearTransferOETF"];case Mi:case Eh:return[n,"sRGBTransferOETF"];default:return console.warn("THREE.WebGLProgram: Unsupported color space:",i),[n,"LinearTransferOETF"]}}function hf(i,t,e){const n=i.getShaderParameter(t,i.COMPILE_STATUS),s=i.getShaderInfoLog(t).trim();if(n&&s==="")return"";const r=/ERROR: 0:(\d+)/.exec(s);if(r){const o=parseInt(r[1]);return e.toUpperCase()+`

`+s+`

`+LM(i.getShaderSource(t),o)}else return s}function IM(i,t){const e=DM(t);return`vec4 ${i}( vec4 value ) { return ${e[0]}( ${e[1]}( value ) ); }`}function UM(i,t){let e;switch(t){case Kg:e="Linear";break;case $g:e="Reinhard";break;case Zg:e="Cineon";break;case Jg:e="ACESFilmic";break;case t_:e="AgX";break;case e_:e="Neutral";break;case Qg:e="Custom";break;default:console.warn("THREE.WebGLProgram: Unsupported toneMapping:",t),e="Linear"}return"vec3 "+i+"( vec3 color ) { return "+e+"ToneMapping( color ); }"}const sa=new $;function NM(){ye.getLuminanceCoefficients(sa);const i=sa.x.toFixed(4),t=sa.y.toFixed(4),e=sa.z.toFixed(4);return["float luminance( const in vec3 rgb ) {",`	const vec3 weights = vec3( ${i}, ${t}, ${e} );`,"	return dot( weights, rgb );","}"].join(`
`)}function kM(i){return[i.extensionClipCullDistance?"#extension GL_ANGLE_clip_cull_distance : require":"",i.extensionMultiDraw?"#extension GL_ANGLE_multi_draw : require":""].filter(ho).join(`
`)}function OM(i){const t=[];for(const e in i){const n=i[e];n!==!1&&t.push("#define "+e+" "+n)}return t.join(`
`)}function FM(i,t){const e={},n=i.getProgramParameter(t,i.ACTIVE_ATTRIBUTES);for(let s=0;s<n;s++){const r=i.getActiveAttrib(t,s),o=r.name;let a=1;r.type===i.FLOAT_MAT2&&(a=2),r.type===i.FLOAT_MAT3&&(a=3),r.type===i.FLOAT_MAT4&&(a=4),e[o]={type:r.type,location:i.getAttribLocation(t,o),locationSize:a}}return e}function ho(i){return i!==""}function uf(i,t){const e=t.numSpotLightShadows+t.numSpotLightMaps-t.numSpotLightShadowsWithMaps;return i.replace(/NUM_DIR_LIGHTS/g,t.numDirLights).replace(/NUM_SPOT_LIGHTS/g,t.numSpotLights).replace(/NUM_SPOT_LIGHT_MAPS/g,t.numSpotLightMaps).replace(/NUM_SPOT_LIGHT_COORDS/g,e).replace(/NUM_RECT_AREA_LIGHTS/g,t.numRectAreaLights).replace(/NUM_POINT_LIGHTS/g,t.numPointLights).replace(/NUM_HEMI_LIGHTS/g,t.numHemiLights).replace(/NUM_DIR_LIGHT_SHADOWS/g,t.numDirLightShadows).replace(/NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS/g,t.numSpotLightShadowsWithMaps).replace(/NUM_SPOT_LIGHT_SHADOWS/g,t.numSpotLightShadows).replace(/NUM_POINT_LIGHT_SHADOWS/g,t.numPointLightShadows)}function ff(i,t){return i.replace(/NUM_CLIPPING_PLANES/g,t.numClippingPlanes).replace(/UNION_CLIPPING_PLANES/g,t.numClippingPlanes-t.numClipIntersection)}const BM=/^[ \t]*#include +<([\w\d./]+)>/gm;function Qc(i){return i.replace(BM,HM)}const zM=new Map;function HM(i,t){let e=oe[t];if(e===void 0){const n=zM.get(t);if(n!==void 0)e=oe[n],console.warn('THREE.WebGLRenderer: Shader chunk "%s" has been deprecated. Use "%s" instead.',t,n);else throw new Error("Can not resolve #include <"+t+">")}return Qc(e)}const GM=/#pragma unroll_loop_start\s+for\s*\(\s*int\s+i\s*=\s*(\d+)\s*;\s*i\s*<\s*(\d+)\s*;\s*i\s*\+\+\s*\)\s*{([\s\S]+?)}\s+#pragma unroll_loop_end/g;function df(i){return i.replace(GM,VM)}function VM(i,t,e,n){let s="";for(let r=parseInt(t);r<parseInt(e);r++)s+=n.replace(/\[\s*i\s*\]/g,"[ "+r+" ]").replace(/UNROLLED_LOOP_INDEX/g,r);return s}function pf(i){let t=`precision ${i.precision} float;
	precision ${i.precision} int;
	precision ${i.precision} sampler2D;
	precision ${i.precision} samplerCube;
	precision ${i.precision} sampler3D;
	precision ${i.precision} sampler2DArray;
	precision ${i.precision} sampler2DShadow;
	precision ${i.precision} samplerCubeShadow;
	precision ${i.precision} sampler2DArrayShadow;
	precision ${i.precision} isampler2D;
	precision ${i.precision} isampler3D;
	precision ${i.precision} isamplerCube;
	precision ${i.precision} isampler2DArray;
	precision ${i.precision} usampler2D;
	precision ${i.precision} usampler3D;
	precision ${i.precision} usamplerCube;
	precision ${i.precision} usampler2DArray;
	`;return i.precision==="highp"?t+=`
#define HIGH_PRECISION`:i.precision==="mediump"?t+=`
#define MEDIUM_PRECISION`:i.precision==="lowp"&&(t+=`
#define LOW_PRECISION`),t}function WM(i){let t="SHADOWMAP_TYPE_BASIC";return i.shadowMapType===kd?t="SHADOWMAP_TYPE_PCF":i.shadowMapType===Rg?t="SHADOWMAP_TYPE_PCF_SOFT":i.shadowMapType===Ni&&(t="SHADOWMAP_TYPE_VSM"),t}function XM(i){let t="ENVMAP_TYPE_CUBE";if(i.envMap)switch(i.envMapMode){case Rr:case Cr:t="ENVMAP_TYPE_CUBE";break;case Ha:t="ENVMAP_TYPE_CUBE_UV";break}return t}function qM(i){let t="ENVMAP_MODE_REFLECTION";if(i.envMap)switch(i.envMapMode){case Cr:t="ENVMAP_MODE_REFRACTION";break}return t}function YM(i){let t="ENVMAP_BLENDING_NONE";if(i.envMap)switch(i.combine){case gh:t="ENVMAP_BLENDING_MULTIPLY";break;case Yg:t="ENVMAP_BLENDING_MIX";break;case jg:t="ENVMAP_BLENDING_ADD";break}return t}function jM(i){const t=i.envMapCubeUVHeight;if(t===null)return null;const e=Math.log2(t)-2,n=1/t;return{texelWidth:1/(3*Math.max(Math.pow(2,e),7*16)),texelHeight:n,maxMip:e}}function KM(i,t,e,n){const s=i.getContext(),r=e.defines;let o=e.vertexShader,a=e.fragmentShader;const l=WM(e),c=XM(e),u=qM(e),f=YM(e),h=jM(e),_=kM(e),x=OM(r),M=s.createProgram();let p,d,C=e.glslVersion?"#version "+e.glslVersion+`
`:"";e.isRawShaderMaterial?(p=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,x].filter(ho).join(`
`),p.length>0&&(p+=`
`),d=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,x].filter(ho).join(`
`),d.length>0&&(d+=`
`)):(p=[pf(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,x,e.extensionClipCullDistance?"#define USE_CLIP_DISTANCE":"",e.batching?"#define USE_BATCHING":"",e.batchingColor?"#define USE_BATCHING_COLOR":"",e.instancing?"#define USE_INSTANCING":"",e.instancingColor?"#define USE_INSTANCING_COLOR":"",e.instancingMorph?"#define USE_INSTANCING_MORPH":"",e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.map?"#define USE_MAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+u:"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.displacementMap?"#define USE_DISPLACEMENTMAP":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.mapUv?"#define MAP_UV "+e.mapUv:"",e.alphaMapUv?"#define ALPHAMAP_UV "+e.alphaMapUv:"",e.lightMapUv?"#define LIGHTMAP_UV "+e.lightMapUv:"",e.aoMapUv?"#define AOMAP_UV "+e.aoMapUv:"",e.emissiveMapUv?"#define EMISSIVEMAP_UV "+e.emissiveMapUv:"",e.bumpMapUv?"#define BUMPMAP_UV "+e.bumpMapUv:"",e.normalMapUv?"#define NORMALMAP_UV "+e.normalMapUv:"",e.displacementMapUv?"#define DISPLACEMENTMAP_UV "+e.displacementMapUv:"",e.metalnessMapUv?"#define METALNESSMAP_UV "+e.metalnessMapUv:"",e.roughnessMapUv?"#define ROUGHNESSMAP_UV "+e.roughnessMapUv:"",e.anisotropyMapUv?"#define ANISOTROPYMAP_UV "+e.anisotropyMapUv:"",e.clearcoatMapUv?"#define CLEARCOATMAP_UV "+e.clearcoatMapUv:"",e.clearcoatNormalMapUv?"#define CLEARCOAT_NORMALMAP_UV "+e.clearcoatNormalMapUv:"",e.clearcoatRoughnessMapUv?"#define CLEARCOAT_ROUGHNESSMAP_UV "+e.clearcoatRoughnessMapUv:"",e.iridescenceMapUv?"#define IRIDESCENCEMAP_UV "+e.iridescenceMapUv:"",e.iridescenceThicknessMapUv?"#define IRIDESCENCE_THICKNESSMAP_UV "+e.iridescenceThicknessMapUv:"",e.sheenColorMapUv?"#define SHEEN_COLORMAP_UV "+e.sheenColorMapUv:"",e.sheenRoughnessMapUv?"#define SHEEN_ROUGHNESSMAP_UV "+e.sheenRoughnessMapUv:"",e.specularMapUv?"#define SPECULARMAP_UV "+e.specularMapUv:"",e.specularColorMapUv?"#define SPECULAR_COLORMAP_UV "+e.specularColorMapUv:"",e.specularIntensityMapUv?"#define SPECULAR_INTENSITYMAP_UV "+e.specularIntensityMapUv:"",e.transmissionMapUv?"#define TRANSMISSIONMAP_UV "+e.transmissionMapUv:"",e.thicknessMapUv?"#define THICKNESSMAP_UV "+e.thicknessMapUv:"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexColors?"#define USE_COLOR":"",e.vertexAlphas?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.flatShading?"#define FLAT_SHADED":"",e.skinning?"#define USE_SKINNING":"",e.morphTargets?"#define USE_MORPHTARGETS":"",e.morphNormals&&e.flatShading===!1?"#define USE_MORPHNORMALS":"",e.morphColors?"#define USE_MORPHCOLORS":"",e.morphTargetsCount>0?"#define MORPHTARGETS_TEXTURE_STRIDE "+e.morphTextureStride:"",e.morphTargetsCount>0?"#define MORPHTARGETS_COUNT "+e.morphTargetsCount:"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+l:"",e.sizeAttenuation?"#define USE_SIZEATTENUATION":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.logarithmicDepthBuffer?"#define USE_LOGDEPTHBUF":"",e.reverseDepthBuffer?"#define USE_REVERSEDEPTHBUF":"","uniform mat4 modelMatrix;","uniform mat4 modelViewMatrix;","uniform mat4 projectionMatrix;","uniform mat4 viewMatrix;","uniform mat3 normalMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;","#ifdef USE_INSTANCING","	attribute mat4 instanceMatrix;","#endif","#ifdef USE_INSTANCING_COLOR","	attribute vec3 instanceColor;","#endif","#ifdef USE_INSTANCING_MORPH","	uniform sampler2D morphTexture;","#endif","attribute vec3 position;","attribute vec3 normal;","attribute vec2 uv;","#ifdef USE_UV1","	attribute vec2 uv1;","#endif","#ifdef USE_UV2","	attribute vec2 uv2;","#endif","#ifdef USE_UV3","	attribute vec2 uv3;","#endif","#ifdef USE_TANGENT","	attribute vec4 tangent;","#endif","#if defined( USE_COLOR_ALPHA )","	attribute vec4 color;","#elif defined( USE_COLOR )","	attribute vec3 color;","#endif","#ifdef USE_SKINNING","	attribute vec4 skinIndex;","	attribute vec4 skinWeight;","#endif",`
`].filter(ho).join(`
`),d=[pf(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,x,e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.alphaToCoverage?"#define ALPHA_TO_COVERAGE":"",e.map?"#define USE_MAP":"",e.matcap?"#define USE_MATCAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+c:"",e.envMap?"#define "+u:"",e.envMap?"#define "+f:"",h?"#define CUBEUV_TEXEL_WIDTH "+h.texelWidth:"",h?"#define CUBEUV_TEXEL_HEIGHT "+h.texelHeight:"",h?"#define CUBEUV_MAX_MIP "+h.maxMip+".0":"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoat?"#define USE_CLEARCOAT":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.dispersion?"#define USE_DISPERSION":"",e.iridescence?"#define USE_IRIDESCENCE":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaTest?"#define USE_ALPHATEST":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.sheen?"#define USE_SHEEN":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexColors||e.instancingColor||e.batchingColor?"#define USE_COLOR":"",e.vertexAlphas?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.gradientMap?"#define USE_GRADIENTMAP":"",e.flatShading?"#define FLAT_SHADED":"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+l:"",e.premultipliedAlpha?"#define PREMULTIPLIED_ALPHA":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.decodeVideoTexture?"#define DECODE_VIDEO_TEXTURE":"",e.logarithmicDepthBuffer?"#define USE_LOGDEPTHBUF":"",e.reverseDepthBuffer?"#define USE_REVERSEDEPTHBUF":"","uniform mat4 viewMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;",e.toneMapping!==as?"#define TONE_MAPPING":"",e.toneMapping!==as?oe.tonemapping_pars_fragment:"",e.toneMapping!==as?UM("toneMapping",e.toneMapping):"",e.dithering?"#define DITHERING":"",e.opaque?"#define OPAQUE":"",oe.colorspace_pars_fragment,IM("linearToOutputTexel",e.outputColorSpace),NM(),e.useDepthPacking?"#define DEPTH_PACKING "+e.depthPacking:"",`
`].filter(ho).join(`
`)),o=Qc(o),o=uf(o,e),o=ff(o,e),a=Qc(a),a=uf(a,e),a=ff(a,e),o=df(o),a=df(a),e.isRawShaderMaterial!==!0&&(C=`#version 300 es
`,p=[_,"#define attribute in","#define varying out","#define texture2D texture"].join(`
`)+`
`+p,d=["#define varying in",e.glslVersion===Pu?"":"layout(location = 0) out highp vec4 pc_fragColor;",e.glslVersion===Pu?"":"#define gl_FragColor pc_fragColor","#define gl_FragDepthEXT gl_FragDepth","#define texture2D texture","#define textureCube texture","#define texture2DProj textureProj","#define texture2DLodEXT textureLod","#define texture2DProjLodEXT textureProjLod","#define textureCubeLodEXT textureLod","#define texture2DGradEXT textureGrad","#define texture2DProjGradEXT textureProjGrad","#define textureCubeGradEXT textureGrad"].join(`
`)+`
`+d);const b=C+p+o,R=C+d+a,D=cf(s,s.VERTEX_SHADER,b),A=cf(s,s.FRAGMENT_SHADER,R);s.attachShader(M,D),s.attachShader(M,A),e.index0AttributeName!==void 0?s.bindAttribLocation(M,0,e.index0AttributeName):e.morphTargets===!0&&s.bindAttribLocation(M,0,"position"),s.linkProgram(M);function y(m){if(i.debug.checkShaderErrors){const E=s.getProgramInfoLog(M).trim(),N=s.getShaderInfoLog(D).trim(),F=s.getShaderInfoLog(A).trim();let B=!0,G=!0;if(s.getProgramParameter(M,s.LINK_STATUS)===!1)if(B=!1,typeof i.debug.onShaderError=="function")i.debug.onShaderError(s,M,D,A);else{const K=hf(s,D,"vertex"),Q=hf(s,A,"fragment");console.error("THREE.WebGLProgram: Shader Error "+s.getError()+" - VALIDATE_STATUS "+s.getProgramParameter(M,s.VALIDATE_STATUS)+`

Material Name: `+m.name+`
Material Type: `+m.type+`

Program Info Log: `+E+`
`+K+`
`+Q)}else E!==""?console.warn("THREE.WebGLProgram: Program Info Log:",E):(N===""||F==="")&&(G=!1);G&&(m.diagnostics={runnable:B,programLog:E,vertexShader:{log:N,prefix:p},fragmentShader:{log:F,prefix:d}})}s.deleteShader(D),s.deleteShader(A),P=new ba(s,M),O=FM(s,M)}let P;this.getUniforms=function(){return P===void 0&&y(this),P};let O;this.getAttributes=function(){return O===void 0&&y(this),O};let g=e.rendererExtensionParallelShaderCompile===!1;return this.isReady=function(){return g===!1&&(g=s.getProgramParameter(M,CM)),g},this.destroy=function(){n.releaseStatesOfProgram(this),s.deleteProgram(M),this.program=void 0},this.type=e.shaderType,this.name=e.shaderName,this.id=PM++,this.cacheKey=t,this.usedTimes=1,this.program=M,this.vertexShader=D,this.fragmentShader=A,this}let $M=0;class ZM{constructor(){this.shaderCache=new Map,this.materialCache=new Map}update(t){const e=t.vertexShader,n=t.fragmentShader,s=this._getShaderStage(e),r=this._getShaderStage(n),o=this._getShaderCacheForMaterial(t);return o.has(s)===!1&&(o.add(s),s.usedTimes++),o.has(r)===!1&&(o.add(r),r.usedTimes++),this}remove(t){const e=this.materialCache.get(t);for(const n of e)n.usedTimes--,n.usedTimes===0&&this.shaderCache.delete(n.code);return this.materialCache.delete(t),this}getVertexShaderID(t){return this._getShaderStage(t.vertexShader).id}getFragmentShaderID(t){return this._getShaderStage(t.fragmentShader).id}dispose(){this.shaderCache.clear(),this.materialCache.clear()}_getShaderCacheForMaterial(t){const e=this.materialCache;let n=e.get(t);return n===void 0&&(n=new Set,e.set(t,n)),n}_getShaderStage(t){const e=this.shaderCache;let n=e.get(t);return n===void 0&&(n=new JM(t),e.set(t,n)),n}}class JM{constructor(t){this.id=$M++,this.code=t,this.usedTimes=0}}function QM(i,t,e,n,s,r,o){const a=new Qd,l=new ZM,c=new Set,u=[],f=s.logarithmicDepthBuffer,h=s.reverseDepthBuffer,_=s.vertexTextures;let x=s.precision;const M={MeshDepthMaterial:"depth",MeshDistanceMaterial:"distanceRGBA",MeshNormalMaterial:"normal",MeshBasicMaterial:"basic",MeshLambertMaterial:"lambert",MeshPhongMaterial:"phong",MeshToonMaterial:"toon",MeshStandardMaterial:"physical",MeshPhysicalMaterial:"physical",MeshMatcapMaterial:"matcap",LineBasicMaterial:"basic",LineDashedMaterial:"dashed",PointsMaterial:"points",ShadowMaterial:"shadow",SpriteMaterial:"sprite"};function p(g){return c.add(g),g===0?"uv":`uv${g}`}function d(g,m,E,N,F){const B=N.fog,G=F.geometry,K=g.isMeshStandardMaterial?N.environment:null,Q=(g.isMeshStandardMaterial?e:t).get(g.envMap||K),dt=Q&&Q.mapping===Ha?Q.image.height:null,ct=M[g.type];g.precision!==null&&(x=s.getMaxPrecision(g.precision),x!==g.precision&&console.warn("THREE.WebGLProgram.getParameters:",g.precision,"not supported, using",x,"instead."));const gt=G.morphAttributes.position||G.morphAttributes.normal||G.morphAttributes.color,xt=gt!==void 0?gt.length:0;let Vt=0;G.morphAttributes.position!==void 0&&(Vt=1),G.morphAttributes.normal!==void 0&&(Vt=2),G.morphAttributes.color!==void 0&&(Vt=3);let rt,pt,Dt,St;if(ct){const We=yi[ct];rt=We.vertexShader,pt=We.fragmentShader}else rt=g.vertexShader,pt=g.fragmentShader,l.update(g),Dt=l.getVertexShaderID(g),St=l.getFragmentShaderID(g);const Z=i.getRenderTarget(),J=F.isInstancedMesh===!0,Y=F.isBatchedMesh===!0,ot=!!g.map,at=!!g.matcap,I=!!Q,Ot=!!g.aoMap,Mt=!!g.lightMap,Ht=!!g.bumpMap,At=!!g.normalMap,Et=!!g.displacementMap,Xt=!!g.emissiveMap,L=!!g.metalnessMap,w=!!g.roughnessMap,V=g.anisotropy>0,it=g.clearcoat>0,ht=g.dispersion>0,nt=g.iridescence>0,It=g.sheen>0,wt=g.transmission>0,Ut=V&&!!g.anisotropyMap,re=it&&!!g.clearcoatMap,mt=it&&!!g.clearcoatNormalMap,Rt=it&&!!g.clearcoatRoughnessMap,jt=nt&&!!g.iridescenceMap,$t=nt&&!!g.iridescenceThicknessMap,Lt=It&&!!g.sheenColorMap,ne=It&&!!g.sheenRoughnessMap,Qt=!!g.specularMap,pe=!!g.specularColorMap,q=!!g.specularIntensityMap,Tt=wt&&!!g.transmissionMap,lt=wt&&!!g.thicknessMap,ft=!!g.gradientMap,Nt=!!g.alphaMap,Bt=g.alphaTest>0,fe=!!g.alphaHash,Ve=!!g.extensions;let mn=as;g.toneMapped&&(Z===null||Z.isXRRenderTarget===!0)&&(mn=i.toneMapping);const bt={shaderID:ct,shaderType:g.type,shaderName:g.name,vertexShader:rt,fragmentShader:pt,defines:g.defines,customVertexShaderID:Dt,customFragmentShaderID:St,isRawShaderMaterial:g.isRawShaderMaterial===!0,glslVersion:g.glslVersion,precision:x,batching:Y,batchingColor:Y&&F._colorsTexture!==null,instancing:J,instancingColor:J&&F.instanceColor!==null,instancingMorph:J&&F.morphTexture!==null,supportsVertexTextures:_,outputColorSpace:Z===null?i.outputColorSpace:Z.isXRRenderTarget===!0?Z.texture.colorSpace:fs,alphaToCoverage:!!g.alphaToCoverage,map:ot,matcap:at,envMap:I,envMapMode:I&&Q.mapping,envMapCubeUVHeight:dt,aoMap:Ot,lightMap:Mt,bumpMap:Ht,normalMap:At,displacementMap:_&&Et,emissiveMap:Xt,normalMapObjectSpace:At&&g.normalMapType===r_,normalMapTangentSpace:At&&g.normalMapType===jd,metalnessMap:L,roughnessMap:w,anisotropy:V,anisotropyMap:Ut,clearcoat:it,clearcoatMap:re,clearcoatNormalMap:mt,clearcoatRoughnessMap:Rt,dispersion:ht,iridescence:nt,iridescenceMap:jt,iridescenceThicknessMap:$t,sheen:It,sheenColorMap:Lt,sheenRoughnessMap:ne,specularMap:Qt,specularColorMap:pe,specularIntensityMap:q,transmission:wt,transmissionMap:Tt,thicknessMap:lt,gradientMap:ft,opaque:g.transparent===!1&&g.blending===Er&&g.alphaToCoverage===!1,alphaMap:Nt,alphaTest:Bt,alphaHash:fe,combine:g.combine,mapUv:ot&&p(g.map.channel),aoMapUv:Ot&&p(g.aoMap.channel),lightMapUv:Mt&&p(g.lightMap.channel),bumpMapUv:Ht&&p(g.bumpMap.channel),normalMapUv:At&&p(g.normalMap.channel),displacementMapUv:Et&&p(g.displacementMap.channel),emissiveMapUv:Xt&&p(g.emissiveMap.channel),metalnessMapUv:L&&p(g.metalnessMap.channel),roughnessMapUv:w&&p(g.roughnessMap.channel),anisotropyMapUv:Ut&&p(g.anisotropyMap.channel),clearcoatMapUv:re&&p(g.clearcoatMap.channel),clearcoatNormalMapUv:mt&&p(g.clearcoatNormalMap.channel),clearcoatRoughnessMapUv:Rt&&p(g.clearcoatRoughnessMap.channel),iridescenceMapUv:jt&&p(g.iridescenceMap.channel),iridescenceThicknessMapUv:$t&&p(g.iridescenceThicknessMap.channel),sheenColorMapUv:Lt&&p(g.sheenColorMap.channel),sheenRoughnessMapUv:ne&&p(g.sheenRoughnessMap.channel),specularMapUv:Qt&&p(g.specularMap.channel),specularColorMapUv:pe&&p(g.specularColorMap.channel),specularIntensityMapUv:q&&p(g.specularIntensityMap.channel),transmissionMapUv:Tt&&p(g.transmissionMap.channel),thicknessMapUv:lt&&p(g.thicknessMap.channel),alphaMapUv:Nt&&p(g.alphaMap.channel),vertexTangents:!!G.attributes.tangent&&(At||V),vertexColors:g.vertexColors,vertexAlphas:g.vertexColors===!0&&!!G.attributes.color&&G.attributes.color.itemSize===4,pointsUvs:F.isPoints===!0&&!!G.attributes.uv&&(ot||Nt),fog:!!B,useFog:g.fog===!0,fogExp2:!!B&&B.isFogExp2,flatShading:g.flatShading===!0,sizeAttenuation:g.sizeAttenuation===!0,logarithmicDepthBuffer:f,reverseDepthBuffer:h,skinning:F.isSkinnedMesh===!0,morphTargets:G.morphAttributes.position!==void 0,morphNormals:G.morphAttributes.normal!==void 0,morphColors:G.morphAttributes.color!==void 0,morphTargetsCount:xt,morphTextureStride:Vt,numDirLights:m.directional.length,numPointLights:m.point.length,numSpotLights:m.spot.length,numSpotLightMaps:m.spotLightMap.length,numRectAreaLights:m.rectArea.length,numHemiLights:m.hemi.length,numDirLightShadows:m.directionalShadowMap.length,numPointLightShadows:m.pointShadowMap.length,numSpotLightShadows:m.spotShadowMap.length,numSpotLightShadowsWithMaps:m.numSpotLightShadowsWithMaps,numLightProbes:m.numLightProbes,numClippingPlanes:o.numPlanes,numClipIntersection:o.numIntersection,dithering:g.dithering,shadowMapEnabled:i.shadowMap.enabled&&E.length>0,shadowMapType:i.shadowMap.type,toneMapping:mn,decodeVideoTexture:ot&&g.map.isVideoTexture===!0&&ye.getTransfer(g.map.colorSpace)===Oe,premultipliedAlpha:g.premultipliedAlpha,doubleSided:g.side===ki,flipSided:g.side===Nn,useDepthPacking:g.depthPacking>=0,depthPacking:g.depthPacking||0,index0AttributeName:g.index0AttributeName,extensionClipCullDistance:Ve&&g.extensions.clipCullDistance===!0&&n.has("WEBGL_clip_cull_distance"),extensionMultiDraw:(Ve&&g.extensions.multiDraw===!0||Y)&&n.has("WEBGL_multi_draw"),rendererExtensionParallelShaderCompile:n.has("KHR_parallel_shader_compile"),customProgramCacheKey:g.customProgramCacheKey()};return bt.vertexUv1s=c.has(1),bt.vertexUv2s=c.has(2),bt.vertexUv3s=c.has(3),c.clear(),bt}function C(g){const m=[];if(g.shaderID?m.push(g.shaderID):(m.push(g.customVertexShaderID),m.push(g.customFragmentShaderID)),g.defines!==void 0)for(const E in g.defines)m.push(E),m.push(g.defines[E]);return g.isRawShaderMaterial===!1&&(b(m,g),R(m,g),m.push(i.outputColorSpace)),m.push(g.customProgramCacheKey),m.join()}function b(g,m){g.push(m.precision),g.push(m.outputColorSpace),g.push(m.envMapMode),g.push(m.envMapCubeUVHeight),g.push(m.mapUv),g.push(m.alphaMapUv),g.push(m.lightMapUv),g.push(m.aoMapUv),g.push(m.bumpMapUv),g.push(m.normalMapUv),g.push(m.displacementMapUv),g.push(m.emissiveMapUv),g.push(m.metalnessMapUv),g.push(m.roughnessMapUv),g.push(m.anisotropyMapUv),g.push(m.clearcoatMapUv),g.push(m.clearcoatNormalMapUv),g.push(m.clearcoatRoughnessMapUv),g.push(m.iridescenceMapUv),g.push(m.iridescenceThicknessMapUv),g.push(m.sheenColorMapUv),g.push(m.sheenRoughnessMapUv),g.push(m.specularMapUv),g.push(m.specularColorMapUv),g.push(m.specularIntensityMapUv),g.push(m.transmissionMapUv),g.push(m.thicknessMapUv),g.push(m.combine),g.push(m.fogExp2),g.push(m.sizeAttenuation),g.push(m.morphTargetsCount),g.push(m.morphAttributeCount),g.push(m.numDirLights),g.push(m.numPointLights),g.push(m.numSpotLights),g.push(m.numSpotLightMaps),g.push(m.numHemiLights),g.push(m.numRectAreaLights),g.push(m.numDirLightShadows),g.push(m.numPointLightShadows),g.push(m.numSpotLightShadows),g.push(m.numSpotLightShadowsWithMaps),g.push(m.numLightProbes),g.push(m.shadowMapType),g.push(m.toneMapping),g.push(m.numClippingPlanes),g.push(m.numClipIntersection),g.push(m.depthPacking)}function R(g,m){a.disableAll(),m.supportsVertexTextures&&a.enable(0),m.instancing&&a.enable(1),m.instancingColor&&a.enable(2),m.instancingMorph&&a.enable(3),m.matcap&&a.enable(4),m.envMap&&a.enable(5),m.normalMapObjectSpace&&a.enable(6),m.normalMapTangentSpace&&a.enable(7),m.clearcoat&&a.enable(8),m.iridescence&&a.enable(9),m.alphaTest&&a.enable(10),m.vertexColors&&a.enable(11),m.vertexAlphas&&a.enable(12),m.vertexUv1s&&a.enable(13),m.vertexUv2s&&a.enable(14),m.vertexUv3s&&a.enable(15),m.vertexTangents&&a.enable(16),m.anisotropy&&a.enable(17),m.alphaHash&&a.enable(18),m.batching&&a.enable(19),m.dispersion&&a.enable(20),m.batchingColor&&a.enable(21),g.push(a.mask),a.disableAll(),m.fog&&a.enable(0),m.useFog&&a.enable(1),m.flatShading&&a.enable(2),m.logarithmicDepthBuffer&&a.enable(3),m.reverseDepthBuffer&&a.enable(4),m.skinning&&a.enable(5),m.morphTargets&&a.enable(6),m.morphNormals&&a.enable(7),m.morphColors&&a.enable(8),m.premultipliedAlpha&&a.enable(9),m.shadowMapEnabled&&a.enable(10),m.doubleSided&&a.enable(11),m.flipSided&&a.enable(12),m.useDepthPacking&&a.enable(13),m.dithering&&a.enable(14),m.transmission&&a.enable(15),m.sheen&&a.enable(16),m.opaque&&a.enable(17),m.pointsUvs&&a.enable(18),m.decodeVideoTexture&&a.enable(19),m.alphaToCoverage&&a.enable(20),g.push(a.mask)}function D(g){const m=M[g.type];let E;if(m){const N=yi[m];E=k_.clone(N.uniforms)}else E=g.uniforms;return E}function A(g,m){let E;for(let N=0,F=u.length;N<F;N++){const B=u[N];if(B.cacheKey===m){E=B,++E.usedTimes;break}}return E===void 0&&(E=new KM(i,m,g,r),u.push(E)),E}function y(g){if(--g.usedTimes===0){const m=u.indexOf(g);u[m]=u[u.length-1],u.pop(),g.destroy()}}function P(g){l.remove(g)}function O(){l.dispose()}return{getParameters:d,getProgramCacheKey:C,getUniforms:D,acquireProgram:A,releaseProgram:y,releaseShaderCache:P,programs:u,dispose:O}}function ty(){let i=new WeakMap;function t(o){return i.has(o)}function e(o){let a=i.get(o);return a===void 0&&(a={},i.set(o,a)),a}function n(o){i.delete(o)}function s(o,a,l){i.get(o)[a]=l}function r(){i=new WeakMap}return{has:t,get:e,remove:n,update:s,dispose:r}}function ey(i,t){return i.groupOrder!==t.groupOrder?i.groupOrder-t.groupOrder:i.renderOrder!==t.renderOrder?i.renderOrder-t.renderOrder:i.material.id!==t.material.id?i.material.id-t.material.id:i.z!==t.z?i.z-t.z:i.id-t.id}function mf(i,t){return i.groupOrder!==t.groupOrder?i.groupOrder-t.groupOrder:i.renderOrder!==t.renderOrder?i.renderOrder-t.renderOrder:i.z!==t.z?t.z-i.z:i.id-t.id}function gf(){const i=[];let t=0;const e=[],n=[],s=[];function r(){t=0,e.length=0,n.length=0,s.length=0}function o(f,h,_,x,M,p){let d=i[t];return d===void 0?(d={id:f.id,object:f,geometry:h,material:_,groupOrder:x,renderOrder:f.renderOrder,z:M,group:p},i[t]=d):(d.id=f.id,d.object=f,d.geometry=h,d.material=_,d.groupOrder=x,d.renderOrder=f.renderOrder,d.z=M,d.group=p),t++,d}function a(f,h,_,x,M,p){const d=o(f,h,_,x,M,p);_.transmission>0?n.push(d):_.transparent===!0?s.push(d):e.push(d)}function l(f,h,_,x,M,p){const d=o(f,h,_,x,M,p);_.transmission>0?n.unshift(d):_.transparent===!0?s.unshift(d):e.unshift(d)}function c(f,h){e.length>1&&e.sort(f||ey),n.length>1&&n.sort(h||mf),s.length>1&&s.sort(h||mf)}function u(){for(let f=t,h=i.length;f<h;f++){const _=i[f];if(_.id===null)break;_.id=null,_.object=null,_.geometry=null,_.material=null,_.group=null}}return{opaque:e,transmissive:n,transparent:s,init:r,push:a,unshift:l,finish:u,sort:c}}function ny(){let i=new WeakMap;function t(n,s){const r=i.get(n);let o;return r===void 0?(o=new gf,i.set(n,[o])):s>=r.length?(o=new gf,r.push(o)):o=r[s],o}function e(){i=new WeakMap}return{get:t,dispose:e}}function iy(){const i={};return{get:function(t){if(i[t.id]!==void 0)return i[t.id];let e;switch(t.type){case"DirectionalLight":e={direction:new $,color:new ee};break;case"SpotLight":e={position:new $,direction:new $,color:new ee,distance:0,coneCos:0,penumbraCos:0,decay:0};break;case"PointLight":e={position:new $,color:new ee,distance:0,decay:0};break;case"HemisphereLight":e={direction:new $,skyColor:new ee,groundColor:new ee};break;case"RectAreaLight":e={color:new ee,position:new $,halfWidth:new $,halfHeight:new $};break}return i[t.id]=e,e}}}function sy(){const i={};return{get:function(t){if(i[t.id]!==void 0)return i[t.id];let e;switch(t.type){case"DirectionalLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new se};break;case"SpotLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new se};break;case"PointLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new se,shadowCameraNear:1,shadowCameraFar:1e3};break}return i[t.id]=e,e}}}let ry=0;function oy(i,t){return(t.castShadow?2:0)-(i.castShadow?2:0)+(t.map?1:0)-(i.map?1:0)}function ay(i){const t=new iy,e=sy(),n={version:0,hash:{directionalLength:-1,pointLength:-1,spotLength:-1,rectAreaLength:-1,hemiLength:-1,numDirectionalShadows:-1,numPointShadows:-1,numSpotShadows:-1,numSpotMaps:-1,numLightProbes:-1},ambient:[0,0,0],probe:[],directional:[],directionalShadow:[],directionalShadowMap:[],directionalShadowMatrix:[],spot:[],spotLightMap:[],spotShadow:[],spotShadowMap:[],spotLightMatrix:[],rectArea:[],rectAreaLTC1:null,rectAreaLTC2:null,point:[],pointShadow:[],pointShadowMap:[],pointShadowMatrix:[],hemi:[],numSpotLightShadowsWithMaps:0,numLightProbes:0};for(let c=0;c<9;c++)n.probe.push(new $);const s=new $,r=new Ge,o=new Ge;function a(c){let u=0,f=0,h=0;for(let O=0;O<9;O++)n.probe[O].set(0,0,0);let _=0,x=0,M=0,p=0,d=0,C=0,b=0,R=0,D=0,A=0,y=0;c.sort(oy);for(let O=0,g=c.length;O<g;O++){const m=c[O],E=m.color,N=m.intensity,F=m.distance,B=m.shadow&&m.shadow.map?m.shadow.map.texture:null;if(m.isAmbientLight)u+=E.r*N,f+=E.g*N,h+=E.b*N;else if(m.isLightProbe){for(let G=0;G<9;G++)n.probe[G].addScaledVector(m.sh.coefficients[G],N);y++}else if(m.isDirectionalLight){const G=t.get(m);if(G.color.copy(m.color).multiplyScalar(m.intensity),m.castShadow){const K=m.shadow,Q=e.get(m);Q.shadowIntensity=K.intensity,Q.shadowBias=K.bias,Q.shadowNormalBias=K.normalBias,Q.shadowRadius=K.radius,Q.shadowMapSize=K.mapSize,n.directionalShadow[_]=Q,n.directionalShadowMap[_]=B,n.directionalShadowMatrix[_]=m.shadow.matrix,C++}n.directional[_]=G,_++}else if(m.isSpotLight){const G=t.get(m);G.position.setFromMatrixPosition(m.matrixWorld),G.color.copy(E).multiplyScalar(N),G.distance=F,G.coneCos=Math.cos(m.angle),G.penumbraCos=Math.cos(m.angle*(1-m.penumbra)),G.decay=m.decay,n.spot[M]=G;const K=m.shadow;if(m.map&&(n.spotLightMap[D]=m.map,D++,K.updateMatrices(m),m.castShadow&&A++),n.spotLightMatrix[M]=K.matrix,m.castShadow){const Q=e.get(m);Q.shadowIntensity=K.intensity,Q.shadowBias=K.bias,Q.shadowNormalBias=K.normalBias,Q.shadowRadius=K.radius,Q.shadowMapSize=K.mapSize,n.spotShadow[M]=Q,n.spotShadowMap[M]=B,R++}M++}else if(m.isRectAreaLight){const G=t.get(m);G.color.copy(E).multiplyScalar(N),G.halfWidth.set(m.width*.5,0,0),G.halfHeight.set(0,m.height*.5,0),n.rectArea[p]=G,p++}else if(m.isPointLight){const G=t.get(m);if(G.color.copy(m.color).multiplyScalar(m.intensity),G.distance=m.distance,G.decay=m.decay,m.castShadow){const K=m.shadow,Q=e.get(m);Q.shadowIntensity=K.intensity,Q.shadowBias=K.bias,Q.shadowNormalBias=K.normalBias,Q.shadowRadius=K.radius,Q.shadowMapSize=K.mapSize,Q.shadowCameraNear=K.camera.near,Q.shadowCameraFar=K.camera.far,n.pointShadow[x]=Q,n.pointShadowMap[x]=B,n.pointShadowMatrix[x]=m.shadow.matrix,b++}n.point[x]=G,x++}else if(m.isHemisphereLight){const G=t.get(m);G.skyColor.copy(m.color).multiplyScalar(N),G.groundColor.copy(m.groundColor).multiplyScalar(N),n.hemi[d]=G,d++}}p>0&&(i.has("OES_texture_float_linear")===!0?(n.rectAreaLTC1=Pt.LTC_FLOAT_1,n.rectAreaLTC2=Pt.LTC_FLOAT_2):(n.rectAreaLTC1=Pt.LTC_HALF_1,n.rectAreaLTC2=Pt.LTC_HALF_2)),n.ambient[0]=u,n.ambient[1]=f,n.ambient[2]=h;const P=n.hash;(P.directionalLength!==_||P.pointLength!==x||P.spotLength!==M||P.rectAreaLength!==p||P.hemiLength!==d||P.numDirectionalShadows!==C||P.numPointShadows!==b||P.numSpotShadows!==R||P.numSpotMaps!==D||P.numLightProbes!==y)&&(n.directional.length=_,n.spot.length=M,n.rectArea.length=p,n.point.length=x,n.hemi.length=d,n.directionalShadow.length=C,n.directionalShadowMap.length=C,n.pointShadow.length=b,n.pointShadowMap.length=b,n.spotShadow.length=R,n.spotShadowMap.length=R,n.directionalShadowMatrix.length=C,n.pointShadowMatrix.length=b,n.spotLightMatrix.length=R+D-A,n.spotLightMap.length=D,n.numSpotLightShadowsWithMaps=A,n.numLightProbes=y,P.directionalLength=_,P.pointLength=x,P.spotLength=M,P.rectAreaLength=p,P.hemiLength=d,P.numDirectionalShadows=C,P.numPointShadows=b,P.numSpotShadows=R,P.numSpotMaps=D,P.numLightProbes=y,n.version=ry++)}function l(c,u){let f=0,h=0,_=0,x=0,M=0;const p=u.matrixWorldInverse;for(let d=0,C=c.length;d<C;d++){const b=c[d];if(b.isDirectionalLight){const R=n.directional[f];R.direction.setFromMatrixPosition(b.matrixWorld),s.setFromMatrixPosition(b.target.matrixWorld),R.direction.sub(s),R.direction.transformDirection(p),f++}else if(b.isSpotLight){const R=n.spot[_];R.position.setFromMatrixPosition(b.matrixWorld),R.position.applyMatrix4(p),R.direction.setFromMatrixPosition(b.matrixWorld),s.setFromMatrixPosition(b.target.matrixWorld),R.direction.sub(s),R.direction.transformDirection(p),_++}else if(b.isRectAreaLight){const R=n.rectArea[x];R.position.setFromMatrixPosition(b.matrixWorld),R.position.applyMatrix4(p),o.identity(),r.copy(b.matrixWorld),r.premultiply(p),o.extractRotation(r),R.halfWidth.set(b.width*.5,0,0),R.halfHeight.set(0,b.height*.5,0),R.halfWidth.applyMatrix4(o),R.halfHeight.applyMatrix4(o),x++}else if(b.isPointLight){const R=n.point[h];R.position.setFromMatrixPosition(b.matrixWorld),R.position.applyMatrix4(p),h++}else if(b.isHemisphereLight){const R=n.hemi[M];R.direction.setFromMatrixPosition(b.matrixWorld),R.direction.transformDirection(p),M++}}}return{setup:a,setupView:l,state:n}}function _f(i){const t=new ay(i),e=[],n=[];function s(u){c.camera=u,e.length=0,n.length=0}function r(u){e.push(u)}function o(u){n.push(u)}function a(){t.setup(e)}function l(u){t.setupView(e,u)}const c={lightsArray:e,shadowsArray:n,camera:null,lights:t,transmissionRenderTarget:{}};return{init:s,state:c,setupLights:a,setupLightsView:l,pushLight:r,pushShadow:o}}function ly(i){let t=new WeakMap;function e(s,r=0){const o=t.get(s);let a;return o===void 0?(a=new _f(i),t.set(s,[a])):r>=o.length?(a=new _f(i),o.push(a)):a=o[r],a}function n(){t=new WeakMap}return{get:e,dispose:n}}class cy extends Fr{constructor(t){super(),this.isMeshDepthMaterial=!0,this.type="MeshDepthMaterial",this.depthPacking=i_,this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.wireframe=!1,this.wireframeLinewidth=1,this.setValues(t)}copy(t){return super.copy(t),this.depthPacking=t.depthPacking,this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this}}class hy extends Fr{constructor(t){super(),this.isMeshDistanceMaterial=!0,this.type="MeshDistanceMaterial",this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.setValues(t)}copy(t){return super.copy(t),this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this}}const uy=`void main() {
	gl_Position = vec4( position, 1.0 );
}`,fy=`uniform sampler2D shadow_pass;
uniform vec2 resolution;
uniform float radius;
#include <packing>
void main() {
	const float samples = float( VSM_SAMPLES );
	float mean = 0.0;
	float squared_mean = 0.0;
	float uvStride = samples <= 1.0 ? 0.0 : 2.0 / ( samples - 1.0 );
	float uvStart = samples <= 1.0 ? 0.0 : - 1.0;
	for ( float i = 0.0; i < samples; i ++ ) {
		float uvOffset = uvStart + i * uvStride;
		#ifdef HORIZONTAL_PASS
			vec2 distribution = unpackRGBATo2Half( texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( uvOffset, 0.0 ) * radius ) / resolution ) );
			mean += distribution.x;
			squared_mean += distribution.y * distribution.y + distribution.x * distribution.x;
		#else
			float depth = unpackRGBAToDepth( texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( 0.0, uvOffset ) * radius ) / resolution ) );
			mean += depth;
			squared_mean += depth * depth;
		#endif
	}
	mean = mean / samples;
	squared_mean = squared_mean / samples;
	float std_dev = sqrt( squared_mean - mean * mean );
	gl_FragColor = pack2HalfToRGBA( vec2( mean, std_dev ) );
}`;function dy(i,t,e){let n=new bh;const s=new se,r=new se,o=new Ye,a=new cy({depthPacking:s_}),l=new hy,c={},u=e.maxTextureSize,f={[cs]:Nn,[Nn]:cs,[ki]:ki},h=new hs({defines:{VSM_SAMPLES:8},uniforms:{shadow_pass:{value:null},resolution:{value:new se},radius:{value:4}},vertexShader:uy,fragmentShader:fy}),_=h.clone();_.defines.HORIZONTAL_PASS=1;const x=new Sn;x.setAttribute("position",new ei(new Float32Array([-1,-1,.5,3,-1,.5,-1,3,.5]),3));const M=new sn(x,h),p=this;this.enabled=!1,this.autoUpdate=!0,this.needsUpdate=!1,this.type=kd;let d=this.type;this.render=function(A,y,P){if(p.enabled===!1||p.autoUpdate===!1&&p.needsUpdate===!1||A.length===0)return;const O=i.getRenderTarget(),g=i.getActiveCubeFace(),m=i.getActiveMipmapLevel(),E=i.state;E.setBlending(os),E.buffers.color.setClear(1,1,1,1),E.buffers.depth.setTest(!0),E.setScissorTest(!1);const N=d!==Ni&&this.type===Ni,F=d===Ni&&this.type!==Ni;for(let B=0,G=A.length;B<G;B++){const K=A[B],Q=K.shadow;if(Q===void 0){console.warn("THREE.WebGLShadowMap:",K,"has no shadow.");continue}if(Q.autoUpdate===!1&&Q.needsUpdate===!1)continue;s.copy(Q.mapSize);const dt=Q.getFrameExtents();if(s.multiply(dt),r.copy(Q.mapSize),(s.x>u||s.y>u)&&(s.x>u&&(r.x=Math.floor(u/dt.x),s.x=r.x*dt.x,Q.mapSize.x=r.x),s.y>u&&(r.y=Math.floor(u/dt.y),s.y=r.y*dt.y,Q.mapSize.y=r.y)),Q.map===null||N===!0||F===!0){const gt=this.type!==Ni?{minFilter:Qn,magFilter:Qn}:{};Q.map!==null&&Q.map.dispose(),Q.map=new ks(s.x,s.y,gt),Q.map.texture.name=K.name+".shadowMap",Q.camera.updateProjectionMatrix()}i.setRenderTarget(Q.map),i.clear();const ct=Q.getViewportCount();for(let gt=0;gt<ct;gt++){const xt=Q.getViewport(gt);o.set(r.x*xt.x,r.y*xt.y,r.x*xt.z,r.y*xt.w),E.viewport(o),Q.updateMatrices(K,gt),n=Q.getFrustum(),R(y,P,Q.camera,K,this.type)}Q.isPointLightShadow!==!0&&this.type===Ni&&C(Q,P),Q.needsUpdate=!1}d=this.type,p.needsUpdate=!1,i.setRenderTarget(O,g,m)};function C(A,y){const P=t.update(M);h.defines.VSM_SAMPLES!==A.blurSamples&&(h.defines.VSM_SAMPLES=A.blurSamples,_.defines.VSM_SAMPLES=A.blurSamples,h.needsUpdate=!0,_.needsUpdate=!0),A.mapPass===null&&(A.mapPass=new ks(s.x,s.y)),h.uniforms.shadow_pass.value=A.map.texture,h.uniforms.resolution.value=A.mapSize,h.uniforms.radius.value=A.radius,i.setRenderTarget(A.mapPass),i.clear(),i.renderBufferDirect(y,null,P,h,M,null),_.uniforms.shadow_pass.value=A.mapPass.texture,_.uniforms.resolution.value=A.mapSize,_.uniforms.radius.value=A.radius,i.setRenderTarget(A.map),i.clear(),i.renderBufferDirect(y,null,P,_,M,null)}function b(A,y,P,O){let g=null;const m=P.isPointLight===!0?A.customDistanceMaterial:A.customDepthMaterial;if(m!==void 0)g=m;else if(g=P.isPointLight===!0?l:a,i.localClippingEnabled&&y.clipShadows===!0&&Array.isArray(y.clippingPlanes)&&y.clippingPlanes.length!==0||y.displacementMap&&y.displacementScale!==0||y.alphaMap&&y.alphaTest>0||y.map&&y.alphaTest>0){const E=g.uuid,N=y.uuid;let F=c[E];F===void 0&&(F={},c[E]=F);let B=F[N];B===void 0&&(B=g.clone(),F[N]=B,y.addEventListener("dispose",D)),g=B}if(g.visible=y.visible,g.wireframe=y.wireframe,O===Ni?g.side=y.shadowSide!==null?y.shadowSide:y.side:g.side=y.shadowSide!==null?y.shadowSide:f[y.side],g.alphaMap=y.alphaMap,g.alphaTest=y.alphaTest,g.map=y.map,g.clipShadows=y.clipShadows,g.clippingPlanes=y.clippingPlanes,g.clipIntersection=y.clipIntersection,g.displacementMap=y.displacementMap,g.displacementScale=y.displacementScale,g.displacementBias=y.displacementBias,g.wireframeLinewidth=y.wireframeLinewidth,g.linewidth=y.linewidth,P.isPointLight===!0&&g.isMeshDistanceMaterial===!0){const E=i.properties.get(g);E.light=P}return g}function R(A,y,P,O,g){if(A.visible===!1)return;if(A.layers.test(y.layers)&&(A.isMesh||A.isLine||A.isPoints)&&(A.castShadow||A.receiveShadow&&g===Ni)&&(!A.frustumCulled||n.intersectsObject(A))){A.modelViewMatrix.multiplyMatrices(P.matrixWorldInverse,A.matrixWorld);const N=t.update(A),F=A.material;if(Array.isArray(F)){const B=N.groups;for(let G=0,K=B.length;G<K;G++){const Q=B[G],dt=F[Q.materialIndex];if(dt&&dt.visible){const ct=b(A,dt,O,g);A.onBeforeShadow(i,A,y,P,N,ct,Q),i.renderBufferDirect(P,null,N,ct,A,Q),A.onAfterShadow(i,A,y,P,N,ct,Q)}}}else if(F.visible){const B=b(A,F,O,g);A.onBeforeShadow(i,A,y,P,N,B,null),i.renderBufferDirect(P,null,N,B,A,null),A.onAfterShadow(i,A,y,P,N,B,null)}}const E=A.children;for(let N=0,F=E.length;N<F;N++)R(E[N],y,P,O,g)}function D(A){A.target.removeEventListener("dispose",D);for(const P in c){const O=c[P],g=A.target.uuid;g in O&&(O[g].dispose(),delete O[g])}}}const py={[mc]:gc,[_c]:Mc,[vc]:yc,[Ar]:xc,[gc]:mc,[Mc]:_c,[yc]:vc,[xc]:Ar};function my(i){function t(){let q=!1;const Tt=new Ye;let lt=null;const ft=new Ye(0,0,0,0);return{setMask:function(Nt){lt!==Nt&&!q&&(i.colorMask(Nt,Nt,Nt,Nt),lt=Nt)},setLocked:function(Nt){q=Nt},setClear:function(Nt,Bt,fe,Ve,mn){mn===!0&&(Nt*=Ve,Bt*=Ve,fe*=Ve),Tt.set(Nt,Bt,fe,Ve),ft.equals(Tt)===!1&&(i.clearColor(Nt,Bt,fe,Ve),ft.copy(Tt))},reset:function(){q=!1,lt=null,ft.set(-1,0,0,0)}}}function e(){let q=!1,Tt=!1,lt=null,ft=null,Nt=null;return{setReversed:function(Bt){Tt=Bt},setTest:function(Bt){Bt?Dt(i.DEPTH_TEST):St(i.DEPTH_TEST)},setMask:function(Bt){lt!==Bt&&!q&&(i.depthMask(Bt),lt=Bt)},setFunc:function(Bt){if(Tt&&(Bt=py[Bt]),ft!==Bt){switch(Bt){case mc:i.depthFunc(i.NEVER);break;case gc:i.depthFunc(i.ALWAYS);break;case _c:i.depthFunc(i.LESS);break;case Ar:i.depthFunc(i.LEQUAL);break;case vc:i.depthFunc(i.EQUAL);break;case xc:i.depthFunc(i.GEQUAL);break;case Mc:i.depthFunc(i.GREATER);break;case yc:i.depthFunc(i.NOTEQUAL);break;default:i.depthFunc(i.LEQUAL)}ft=Bt}},setLocked:function(Bt){q=Bt},setClear:function(Bt){Nt!==Bt&&(i.clearDepth(Bt),Nt=Bt)},reset:function(){q=!1,lt=null,ft=null,Nt=null}}}function n(){let q=!1,Tt=null,lt=null,ft=null,Nt=null,Bt=null,fe=null,Ve=null,mn=null;return{setTest:function(bt){q||(bt?Dt(i.STENCIL_TEST):St(i.STENCIL_TEST))},setMask:function(bt){Tt!==bt&&!q&&(i.stencilMask(bt),Tt=bt)},setFunc:function(bt,We,Le){(lt!==bt||ft!==We||Nt!==Le)&&(i.stencilFunc(bt,We,Le),lt=bt,ft=We,Nt=Le)},setOp:function(bt,We,Le){(Bt!==bt||fe!==We||Ve!==Le)&&(i.stencilOp(bt,We,Le),Bt=bt,fe=We,Ve=Le)},setLocked:function(bt){q=bt},setClear:function(bt){mn!==bt&&(i.clearStencil(bt),mn=bt)},reset:function(){q=!1,Tt=null,lt=null,ft=null,Nt=null,Bt=null,fe=null,Ve=null,mn=null}}}const s=new t,r=new e,o=new n,a=new WeakMap,l=new WeakMap;let c={},u={},f=new WeakMap,h=[],_=null,x=!1,M=null,p=null,d=null,C=null,b=null,R=null,D=null,A=new ee(0,0,0),y=0,P=!1,O=null,g=null,m=null,E=null,N=null;const F=i.getParameter(i.MAX_COMBINED_TEXTURE_IMAGE_UNITS);let B=!1,G=0;const K=i.getParameter(i.VERSION);K.indexOf("WebGL")!==-1?(G=parseFloat(/^WebGL (\d)/.exec(K)[1]),B=G>=1):K.indexOf("OpenGL ES")!==-1&&(G=parseFloat(/^OpenGL ES (\d)/.exec(K)[1]),B=G>=2);let Q=null,dt={};const ct=i.getParameter(i.SCISSOR_BOX),gt=i.getParameter(i.VIEWPORT),xt=new Ye().fromArray(ct),Vt=new Ye().fromArray(gt);function rt(q,Tt,lt,ft){const Nt=new Uint8Array(4),Bt=i.createTexture();i.bindTexture(q,Bt),i.texParameteri(q,i.TEXTURE_MIN_FILTER,i.NEAREST),i.texParameteri(q,i.TEXTURE_MAG_FILTER,i.NEAREST);for(let fe=0;fe<lt;fe++)q===i.TEXTURE_3D||q===i.TEXTURE_2D_ARRAY?i.texImage3D(Tt,0,i.RGBA,1,1,ft,0,i.RGBA,i.UNSIGNED_BYTE,Nt):i.texImage2D(Tt+fe,0,i.RGBA,1,1,0,i.RGBA,i.UNSIGNED_BYTE,Nt);return Bt}const pt={};pt[i.TEXTURE_2D]=rt(i.TEXTURE_2D,i.TEXTURE_2D,1),pt[i.TEXTURE_CUBE_MAP]=rt(i.TEXTURE_CUBE_MAP,i.TEXTURE_CUBE_MAP_POSITIVE_X,6),pt[i.TEXTURE_2D_ARRAY]=rt(i.TEXTURE_2D_ARRAY,i.TEXTURE_2D_ARRAY,1,1),pt[i.TEXTURE_3D]=rt(i.TEXTURE_3D,i.TEXTURE_3D,1,1),s.setClear(0,0,0,1),r.setClear(1),o.setClear(0),Dt(i.DEPTH_TEST),r.setFunc(Ar),Mt(!1),Ht(wu),Dt(i.CULL_FACE),I(os);function Dt(q){c[q]!==!0&&(i.enable(q),c[q]=!0)}function St(q){c[q]!==!1&&(i.disable(q),c[q]=!1)}function Z(q,Tt){return u[q]!==Tt?(i.bindFramebuffer(q,Tt),u[q]=Tt,q===i.DRAW_FRAMEBUFFER&&(u[i.FRAMEBUFFER]=Tt),q===i.FRAMEBUFFER&&(u[i.DRAW_FRAMEBUFFER]=Tt),!0):!1}function J(q,Tt){let lt=h,ft=!1;if(q){lt=f.get(Tt),lt===void 0&&(lt=[],f.set(Tt,lt));const Nt=q.textures;if(lt.length!==Nt.length||lt[0]!==i.COLOR_ATTACHMENT0){for(let Bt=0,fe=Nt.length;Bt<fe;Bt++)lt[Bt]=i.COLOR_ATTACHMENT0+Bt;lt.length=Nt.length,ft=!0}}else lt[0]!==i.BACK&&(lt[0]=i.BACK,ft=!0);ft&&i.drawBuffers(lt)}function Y(q){return _!==q?(i.useProgram(q),_=q,!0):!1}const ot={[Ts]:i.FUNC_ADD,[Pg]:i.FUNC_SUBTRACT,[Lg]:i.FUNC_REVERSE_SUBTRACT};ot[Dg]=i.MIN,ot[Ig]=i.MAX;const at={[Ug]:i.ZERO,[Ng]:i.ONE,[kg]:i.SRC_COLOR,[dc]:i.SRC_ALPHA,[Gg]:i.SRC_ALPHA_SATURATE,[zg]:i.DST_COLOR,[Fg]:i.DST_ALPHA,[Og]:i.ONE_MINUS_SRC_COLOR,[pc]:i.ONE_MINUS_SRC_ALPHA,[Hg]:i.ONE_MINUS_DST_COLOR,[Bg]:i.ONE_MINUS_DST_ALPHA,[Vg]:i.CONSTANT_COLOR,[Wg]:i.ONE_MINUS_CONSTANT_COLOR,[Xg]:i.CONSTANT_ALPHA,[qg]:i.ONE_MINUS_CONSTANT_ALPHA};function I(q,Tt,lt,ft,Nt,Bt,fe,Ve,mn,bt){if(q===os){x===!0&&(St(i.BLEND),x=!1);return}if(x===!1&&(Dt(i.BLEND),x=!0),q!==Cg){if(q!==M||bt!==P){if((p!==Ts||b!==Ts)&&(i.blendEquation(i.FUNC_ADD),p=Ts,b=Ts),bt)switch(q){case Er:i.blendFuncSeparate(i.ONE,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case bu:i.blendFunc(i.ONE,i.ONE);break;case Tu:i.blendFuncSeparate(i.ZERO,i.ONE_MINUS_SRC_COLOR,i.ZERO,i.ONE);break;case Au:i.blendFuncSeparate(i.ZERO,i.SRC_COLOR,i.ZERO,i.SRC_ALPHA);break;default:console.error("THREE.WebGLState: Invalid blending: ",q);break}else switch(q){case Er:i.blendFuncSeparate(i.SRC_ALPHA,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case bu:i.blendFunc(i.SRC_ALPHA,i.ONE);break;case Tu:i.blendFuncSeparate(i.ZERO,i.ONE_MINUS_SRC_COLOR,i.ZERO,i.ONE);break;case Au:i.blendFunc(i.ZERO,i.SRC_COLOR);break;default:console.error("THREE.WebGLState: Invalid blending: ",q);break}d=null,C=null,R=null,D=null,A.set(0,0,0),y=0,M=q,P=bt}return}Nt=Nt||Tt,Bt=Bt||lt,fe=fe||ft,(Tt!==p||Nt!==b)&&(i.blendEquationSeparate(ot[Tt],ot[Nt]),p=Tt,b=Nt),(lt!==d||ft!==C||Bt!==R||fe!==D)&&(i.blendFuncSeparate(at[lt],at[ft],at[Bt],at[fe]),d=lt,C=ft,R=Bt,D=fe),(Ve.equals(A)===!1||mn!==y)&&(i.blendColor(Ve.r,Ve.g,Ve.b,mn),A.copy(Ve),y=mn),M=q,P=!1}function Ot(q,Tt){q.side===ki?St(i.CULL_FACE):Dt(i.CULL_FACE);let lt=q.side===Nn;Tt&&(lt=!lt),Mt(lt),q.blending===Er&&q.transparent===!1?I(os):I(q.blending,q.blendEquation,q.blendSrc,q.blendDst,q.blendEquationAlpha,q.blendSrcAlpha,q.blendDstAlpha,q.blendColor,q.blendAlpha,q.premultipliedAlpha),r.setFunc(q.depthFunc),r.setTest(q.depthTest),r.setMask(q.depthWrite),s.setMask(q.colorWrite);const ft=q.stencilWrite;o.setTest(ft),ft&&(o.setMask(q.stencilWriteMask),o.setFunc(q.stencilFunc,q.stencilRef,q.stencilFuncMask),o.setOp(q.stencilFail,q.stencilZFail,q.stencilZPass)),Et(q.polygonOffset,q.polygonOffsetFactor,q.polygonOffsetUnits),q.alphaToCoverage===!0?Dt(i.SAMPLE_ALPHA_TO_COVERAGE):St(i.SAMPLE_ALPHA_TO_COVERAGE)}function Mt(q){O!==q&&(q?i.frontFace(i.CW):i.frontFace(i.CCW),O=q)}function Ht(q){q!==Tg?(Dt(i.CULL_FACE),q!==g&&(q===wu?i.cullFace(i.BACK):q===Ag?i.cullFace(i.FRONT):i.cullFace(i.FRONT_AND_BACK))):St(i.CULL_FACE),g=q}function At(q){q!==m&&(B&&i.lineWidth(q),m=q)}function Et(q,Tt,lt){q?(Dt(i.POLYGON_OFFSET_FILL),(E!==Tt||N!==lt)&&(i.polygonOffset(Tt,lt),E=Tt,N=lt)):St(i.POLYGON_OFFSET_FILL)}function Xt(q){q?Dt(i.SCISSOR_TEST):St(i.SCISSOR_TEST)}function L(q){q===void 0&&(q=i.TEXTURE0+F-1),Q!==q&&(i.activeTexture(q),Q=q)}function w(q,Tt,lt){lt===void 0&&(Q===null?lt=i.TEXTURE0+F-1:lt=Q);let ft=dt[lt];ft===void 0&&(ft={type:void 0,texture:void 0},dt[lt]=ft),(ft.type!==q||ft.texture!==Tt)&&(Q!==lt&&(i.activeTexture(lt),Q=lt),i.bindTexture(q,Tt||pt[q]),ft.type=q,ft.texture=Tt)}function V(){const q=dt[Q];q!==void 0&&q.type!==void 0&&(i.bindTexture(q.type,null),q.type=void 0,q.texture=void 0)}function it(){try{i.compressedTexImage2D.apply(i,arguments)}catch(q){console.error("THREE.WebGLState:",q)}}function ht(){try{i.compressedTexImage3D.apply(i,arguments)}catch(q){console.error("THREE.WebGLState:",q)}}function nt(){try{i.texSubImage2D.apply(i,arguments)}catch(q){console.error("THREE.WebGLState:",q)}}function It(){try{i.texSubImage3D.apply(i,arguments)}catch(q){console.error("THREE.WebGLState:",q)}}function wt(){try{i.compressedTexSubImage2D.apply(i,arguments)}catch(q){console.error("THREE.WebGLState:",q)}}function Ut(){try{i.compressedTexSubImage3D.apply(i,arguments)}catch(q){console.error("THREE.WebGLState:",q)}}function re(){try{i.texStorage2D.apply(i,arguments)}catch(q){console.error("THREE.WebGLState:",q)}}function mt(){try{i.texStorage3D.apply(i,arguments)}catch(q){console.error("THREE.WebGLState:",q)}}function Rt(){try{i.texImage2D.apply(i,arguments)}catch(q){console.error("THREE.WebGLState:",q)}}function jt(){try{i.texImage3D.apply(i,arguments)}catch(q){console.error("THREE.WebGLState:",q)}}function $t(q){xt.equals(q)===!1&&(i.scissor(q.x,q.y,q.z,q.w),xt.copy(q))}function Lt(q){Vt.equals(q)===!1&&(i.viewport(q.x,q.y,q.z,q.w),Vt.copy(q))}function ne(q,Tt){let lt=l.get(Tt);lt===void 0&&(lt=new WeakMap,l.set(Tt,lt));let ft=lt.get(q);ft===void 0&&(ft=i.getUniformBlockIndex(Tt,q.name),lt.set(q,ft))}function Qt(q,Tt){const ft=l.get(Tt).get(q);a.get(Tt)!==ft&&(i.uniformBlockBinding(Tt,ft,q.__bindingPointIndex),a.set(Tt,ft))}function pe(){i.disable(i.BLEND),i.disable(i.CULL_FACE),i.disable(i.DEPTH_TEST),i.disable(i.POLYGON_OFFSET_FILL),i.disable(i.SCISSOR_TEST),i.disable(i.STENCIL_TEST),i.disable(i.SAMPLE_ALPHA_TO_COVERAGE),i.blendEquation(i.FUNC_ADD),i.blendFunc(i.ONE,i.ZERO),i.blendFuncSeparate(i.ONE,i.ZERO,i.ONE,i.ZERO),i.blendColor(0,0,0,0),i.colorMask(!0,!0,!0,!0),i.clearColor(0,0,0,0),i.depthMask(!0),i.depthFunc(i.LESS),i.clearDepth(1),i.stencilMask(4294967295),i.stencilFunc(i.ALWAYS,0,4294967295),i.stencilOp(i.KEEP,i.KEEP,i.KEEP),i.clearStencil(0),i.cullFace(i.BACK),i.frontFace(i.CCW),i.polygonOffset(0,0),i.activeTexture(i.TEXTURE0),i.bindFramebuffer(i.FRAMEBUFFER,null),i.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),i.bindFramebuffer(i.READ_FRAMEBUFFER,null),i.useProgram(null),i.lineWidth(1),i.scissor(0,0,i.canvas.width,i.canvas.height),i.viewport(0,0,i.canvas.width,i.canvas.height),c={},Q=null,dt={},u={},f=new WeakMap,h=[],_=null,x=!1,M=null,p=null,d=null,C=null,b=null,R=null,D=null,A=new ee(0,0,0),y=0,P=!1,O=null,g=null,m=null,E=null,N=null,xt.set(0,0,i.canvas.width,i.canvas.height),Vt.set(0,0,i.canvas.width,i.canvas.height),s.reset(),r.reset(),o.reset()}return{buffers:{color:s,depth:r,stencil:o},enable:Dt,disable:St,bindFramebuffer:Z,drawBuffers:J,useProgram:Y,setBlending:I,setMaterial:Ot,setFlipSided:Mt,setCullFace:Ht,setLineWidth:At,setPolygonOffset:Et,setScissorTest:Xt,activeTexture:L,bindTexture:w,unbindTexture:V,compressedTexImage2D:it,compressedTexImage3D:ht,texImage2D:Rt,texImage3D:jt,updateUBOMapping:ne,uniformBlockBinding:Qt,texStorage2D:re,texStorage3D:mt,texSubImage2D:nt,texSubImage3D:It,compressedTexSubImage2D:wt,compressedTexSubImage3D:Ut,scissor:$t,viewport:Lt,reset:pe}}function vf(i,t,e,n){const s=gy(n);switch(e){case Hd:return i*t;case Vd:return i*t;case Wd:return i*t*2;case Xd:return i*t/s.components*s.byteLength;case Mh:return i*t/s.components*s.byteLength;case qd:return i*t*2/s.components*s.byteLength;case yh:return i*t*2/s.components*s.byteLength;case Gd:return i*t*3/s.components*s.byteLength;case ui:return i*t*4/s.components*s.byteLength;case Sh:return i*t*4/s.components*s.byteLength;case xa:case Ma:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*8;case ya:case Sa:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*16;case Ac:case Cc:return Math.max(i,16)*Math.max(t,8)/4;case Tc:case Rc:return Math.max(i,8)*Math.max(t,8)/2;case Pc:case Lc:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*8;case Dc:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*16;case Ic:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*16;case Uc:return Math.floor((i+4)/5)*Math.floor((t+3)/4)*16;case Nc:return Math.floor((i+4)/5)*Math.floor((t+4)/5)*16;case kc:return Math.floor((i+5)/6)*Math.floor((t+4)/5)*16;case Oc:return Math.floor((i+5)/6)*Math.floor((t+5)/6)*16;case Fc:return Math.floor((i+7)/8)*Math.floor((t+4)/5)*16;case Bc:return Math.floor((i+7)/8)*Math.floor((t+5)/6)*16;case zc:return Math.floor((i+7)/8)*Math.floor((t+7)/8)*16;case Hc:return Math.floor((i+9)/10)*Math.floor((t+4)/5)*16;case Gc:return Math.floor((i+9)/10)*Math.floor((t+5)/6)*16;case Vc:return Math.floor((i+9)/10)*Math.floor((t+7)/8)*16;case Wc:return Math.floor((i+9)/10)*Math.floor((t+9)/10)*16;case Xc:return Math.floor((i+11)/12)*Math.floor((t+9)/10)*16;case qc:return Math.floor((i+11)/12)*Math.floor((t+11)/12)*16;case Ea:case Yc:case jc:return Math.ceil(i/4)*Math.ceil(t/4)*16;case Yd:case Kc:return Math.ceil(i/4)*Math.ceil(t/4)*8;case $c:case Zc:return Math.ceil(i/4)*Math.ceil(t/4)*16}throw new Error(`Unable to determine texture byte length for ${e} format.`)}function gy(i){switch(i){case Hi:case Fd:return{byteLength:1,components:1};case Mo:case Bd:case wo:return{byteLength:2,components:1};case vh:case xh:return{byteLength:2,components:4};case Ns:case _h:case Oi:return{byteLength:4,components:1};case zd:return{byteLength:4,components:3}}throw new Error(`Unknown texture type ${i}.`)}function _y(i,t,e,n,s,r,o){const a=t.has("WEBGL_multisampled_render_to_texture")?t.get("WEBGL_multisampled_render_to_texture"):null,l=typeof navigator>"u"?!1:/OculusBrowser/g.test(navigator.userAgent),c=new se,u=new WeakMap;let f;const h=new WeakMap;let _=!1;try{_=typeof OffscreenCanvas<"u"&&new OffscreenCanvas(1,1).getContext("2d")!==null}catch{}function x(L,w){return _?new OffscreenCanvas(L,w):Ua("canvas")}function M(L,w,V){let it=1;const ht=Xt(L);if((ht.width>V||ht.height>V)&&(it=V/Math.max(ht.width,ht.height)),it<1)if(typeof HTMLImageElement<"u"&&L instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&L instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&L instanceof ImageBitmap||typeof VideoFrame<"u"&&L instanceof VideoFrame){const nt=Math.floor(it*ht.width),It=Math.floor(it*ht.height);f===void 0&&(f=x(nt,It));const wt=w?x(nt,It):f;return wt.width=nt,wt.height=It,wt.getContext("2d").drawImage(L,0,0,nt,It),console.warn("THREE.WebGLRenderer: Texture has been resized from ("+ht.width+"x"+ht.height+") to ("+nt+"x"+It+")."),wt}else return"data"in L&&console.warn("THREE.WebGLRenderer: Image in DataTexture is too big ("+ht.width+"x"+ht.height+")."),L;return L}function p(L){return L.generateMipmaps&&L.minFilter!==Qn&&L.minFilter!==hi}function d(L){i.generateMipmap(L)}function C(L,w,V,it,ht=!1){if(L!==null){if(i[L]!==void 0)return i[L];console.warn("THREE.WebGLRenderer: Attempt to use non-existing WebGL internal format '"+L+"'")}let nt=w;if(w===i.RED&&(V===i.FLOAT&&(nt=i.R32F),V===i.HALF_FLOAT&&(nt=i.R16F),V===i.UNSIGNED_BYTE&&(nt=i.R8)),w===i.RED_INTEGER&&(V===i.UNSIGNED_BYTE&&(nt=i.R8UI),V===i.UNSIGNED_SHORT&&(nt=i.R16UI),V===i.UNSIGNED_INT&&(nt=i.R32UI),V===i.BYTE&&(nt=i.R8I),V===i.SHORT&&(nt=i.R16I),V===i.INT&&(nt=i.R32I)),w===i.RG&&(V===i.FLOAT&&(nt=i.RG32F),V===i.HALF_FLOAT&&(nt=i.RG16F),V===i.UNSIGNED_BYTE&&(nt=i.RG8)),w===i.RG_INTEGER&&(V===i.UNSIGNED_BYTE&&(nt=i.RG8UI),V===i.UNSIGNED_SHORT&&(nt=i.RG16UI),V===i.UNSIGNED_INT&&(nt=i.RG32UI),V===i.BYTE&&(nt=i.RG8I),V===i.SHORT&&(nt=i.RG16I),V===i.INT&&(nt=i.RG32I)),w===i.RGB_INTEGER&&(V===i.UNSIGNED_BYTE&&(nt=i.RGB8UI),V===i.UNSIGNED_SHORT&&(nt=i.RGB16UI),V===i.UNSIGNED_INT&&(nt=i.RGB32UI),V===i.BYTE&&(nt=i.RGB8I),V===i.SHORT&&(nt=i.RGB16I),V===i.INT&&(nt=i.RGB32I)),w===i.RGBA_INTEGER&&(V===i.UNSIGNED_BYTE&&(nt=i.RGBA8UI),V===i.UNSIGNED_SHORT&&(nt=i.RGBA16UI),V===i.UNSIGNED_INT&&(nt=i.RGBA32UI),V===i.BYTE&&(nt=i.RGBA8I),V===i.SHORT&&(nt=i.RGBA16I),V===i.INT&&(nt=i.RGBA32I)),w===i.RGB&&V===i.UNSIGNED_INT_5_9_9_9_REV&&(nt=i.RGB9_E5),w===i.RGBA){const It=ht?Pa:ye.getTransfer(it);V===i.FLOAT&&(nt=i.RGBA32F),V===i.HALF_FLOAT&&(nt=i.RGBA16F),V===i.UNSIGNED_BYTE&&(nt=It===Oe?i.SRGB8_ALPHA8:i.RGBA8),V===i.UNSIGNED_SHORT_4_4_4_4&&(nt=i.RGBA4),V===i.UNSIGNED_SHORT_5_5_5_1&&(nt=i.RGB5_A1)}return(nt===i.R16F||nt===i.R32F||nt===i.RG16F||nt===i.RG32F||nt===i.RGBA16F||nt===i.RGBA32F)&&t.get("EXT_color_buffer_float"),nt}function b(L,w){let V;return L?w===null||w===Ns||w===Pr?V=i.DEPTH24_STENCIL8:w===Oi?V=i.DEPTH32F_STENCIL8:w===Mo&&(V=i.DEPTH24_STENCIL8,console.warn("DepthTexture: 16 bit depth attachment is not supported with stencil. Using 24-bit attachment.")):w===null||w===Ns||w===Pr?V=i.DEPTH_COMPONENT24:w===Oi?V=i.DEPTH_COMPONENT32F:w===Mo&&(V=i.DEPTH_COMPONENT16),V}function R(L,w){return p(L)===!0||L.isFramebufferTexture&&L.minFilter!==Qn&&L.minFilter!==hi?Math.log2(Math.max(w.width,w.height))+1:L.mipmaps!==void 0&&L.mipmaps.length>0?L.mipmaps.length:L.isCompressedTexture&&Array.isArray(L.image)?w.mipmaps.length:1}function D(L){const w=L.target;w.removeEventListener("dispose",D),y(w),w.isVideoTexture&&u.delete(w)}function A(L){const w=L.target;w.removeEventListener("dispose",A),O(w)}function y(L){const w=n.get(L);if(w.__webglInit===void 0)return;const V=L.source,it=h.get(V);if(it){const ht=it[w.__cacheKey];ht.usedTimes--,ht.usedTimes===0&&P(L),Object.keys(it).length===0&&h.delete(V)}n.remove(L)}function P(L){const w=n.get(L);i.deleteTexture(w.__webglTexture);const V=L.source,it=h.get(V);delete it[w.__cacheKey],o.memory.textures--}function O(L){const w=n.get(L);if(L.depthTexture&&L.depthTexture.dispose(),L.isWebGLCubeRenderTarget)for(let it=0;it<6;it++){if(Array.isArray(w.__webglFramebuffer[it]))for(let ht=0;ht<w.__webglFramebuffer[it].length;ht++)i.deleteFramebuffer(w.__webglFramebuffer[it][ht]);else i.deleteFramebuffer(w.__webglFramebuffer[it]);w.__webglDepthbuffer&&i.deleteRenderbuffer(w.__webglDepthbuffer[it])}else{if(Array.isArray(w.__webglFramebuffer))for(let it=0;it<w.__webglFramebuffer.length;it++)i.deleteFramebuffer(w.__webglFramebuffer[it]);else i.deleteFramebuffer(w.__webglFramebuffer);if(w.__webglDepthbuffer&&i.deleteRenderbuffer(w.__webglDepthbuffer),w.__webglMultisampledFramebuffer&&i.deleteFramebuffer(w.__webglMultisampledFramebuffer),w.__webglColorRenderbuffer)for(let it=0;it<w.__webglColorRenderbuffer.length;it++)w.__webglColorRenderbuffer[it]&&i.deleteRenderbuffer(w.__webglColorRenderbuffer[it]);w.__webglDepthRenderbuffer&&i.deleteRenderbuffer(w.__webglDepthRenderbuffer)}const V=L.textures;for(let it=0,ht=V.length;it<ht;it++){const nt=n.get(V[it]);nt.__webglTexture&&(i.deleteTexture(nt.__webglTexture),o.memory.textures--),n.remove(V[it])}n.remove(L)}let g=0;function m(){g=0}function E(){const L=g;return L>=s.maxTextures&&console.warn("THREE.WebGLTextures: Trying to use "+L+" texture units while this GPU supports only "+s.maxTextures),g+=1,L}function N(L){const w=[];return w.push(L.wrapS),w.push(L.wrapT),w.push(L.wrapR||0),w.push(L.magFilter),w.push(L.minFilter),w.push(L.anisotropy),w.push(L.internalFormat),w.push(L.format),w.push(L.type),w.push(L.generateMipmaps),w.push(L.premultiplyAlpha),w.push(L.flipY),w.push(L.unpackAlignment),w.push(L.colorSpace),w.join()}function F(L,w){const V=n.get(L);if(L.isVideoTexture&&At(L),L.isRenderTargetTexture===!1&&L.version>0&&V.__version!==L.version){const it=L.image;if(it===null)console.warn("THREE.WebGLRenderer: Texture marked for update but no image data found.");else if(it.complete===!1)console.warn("THREE.WebGLRenderer: Texture marked for update but image is incomplete");else{Vt(V,L,w);return}}e.bindTexture(i.TEXTURE_2D,V.__webglTexture,i.TEXTURE0+w)}function B(L,w){const V=n.get(L);if(L.version>0&&V.__version!==L.version){Vt(V,L,w);return}e.bindTexture(i.TEXTURE_2D_ARRAY,V.__webglTexture,i.TEXTURE0+w)}function G(L,w){const V=n.get(L);if(L.version>0&&V.__version!==L.version){Vt(V,L,w);return}e.bindTexture(i.TEXTURE_3D,V.__webglTexture,i.TEXTURE0+w)}function K(L,w){const V=n.get(L);if(L.version>0&&V.__version!==L.version){rt(V,L,w);return}e.bindTexture(i.TEXTURE_CUBE_MAP,V.__webglTexture,i.TEXTURE0+w)}const Q={[wc]:i.REPEAT,[Cs]:i.CLAMP_TO_EDGE,[bc]:i.MIRRORED_REPEAT},dt={[Qn]:i.NEAREST,[n_]:i.NEAREST_MIPMAP_NEAREST,[Fo]:i.NEAREST_MIPMAP_LINEAR,[hi]:i.LINEAR,[_l]:i.LINEAR_MIPMAP_NEAREST,[Ps]:i.LINEAR_MIPMAP_LINEAR},ct={[o_]:i.NEVER,[f_]:i.ALWAYS,[a_]:i.LESS,[Kd]:i.LEQUAL,[l_]:i.EQUAL,[u_]:i.GEQUAL,[c_]:i.GREATER,[h_]:i.NOTEQUAL};function gt(L,w){if(w.type===Oi&&t.has("OES_texture_float_linear")===!1&&(w.magFilter===hi||w.magFilter===_l||w.magFilter===Fo||w.magFilter===Ps||w.minFilter===hi||w.minFilter===_l||w.minFilter===Fo||w.minFilter===Ps)&&console.warn("THREE.WebGLRenderer: Unable to use linear filtering with floating point textures. OES_texture_float_linear not supported on this device."),i.texParameteri(L,i.TEXTURE_WRAP_S,Q[w.wrapS]),i.texParameteri(L,i.TEXTURE_WRAP_T,Q[w.wrapT]),(L===i.TEXTURE_3D||L===i.TEXTURE_2D_ARRAY)&&i.texParameteri(L,i.TEXTURE_WRAP_R,Q[w.wrapR]),i.texParameteri(L,i.TEXTURE_MAG_FILTER,dt[w.magFilter]),i.texParameteri(L,i.TEXTURE_MIN_FILTER,dt[w.minFilter]),w.compareFunction&&(i.texParameteri(L,i.TEXTURE_COMPARE_MODE,i.COMPARE_REF_TO_TEXTURE),i.texParameteri(L,i.TEXTURE_COMPARE_FUNC,ct[w.compareFunction])),t.has("EXT_texture_filter_anisotropic")===!0){if(w.magFilter===Qn||w.minFilter!==Fo&&w.minFilter!==Ps||w.type===Oi&&t.has("OES_texture_float_linear")===!1)return;if(w.anisotropy>1||n.get(w).__currentAnisotropy){const V=t.get("EXT_texture_filter_anisotropic");i.texParameterf(L,V.TEXTURE_MAX_ANISOTROPY_EXT,Math.min(w.anisotropy,s.getMaxAnisotropy())),n.get(w).__currentAnisotropy=w.anisotropy}}}function xt(L,w){let V=!1;L.__webglInit===void 0&&(L.__webglInit=!0,w.addEventListener("dispose",D));const it=w.source;let ht=h.get(it);ht===void 0&&(ht={},h.set(it,ht));const nt=N(w);if(nt!==L.__cacheKey){ht[nt]===void 0&&(ht[nt]={texture:i.createTexture(),usedTimes:0},o.memory.textures++,V=!0),ht[nt].usedTimes++;const It=ht[L.__cacheKey];It!==void 0&&(ht[L.__cacheKey].usedTimes--,It.usedTimes===0&&P(w)),L.__cacheKey=nt,L.__webglTexture=ht[nt].texture}return V}function Vt(L,w,V){let it=i.TEXTURE_2D;(w.isDataArrayTexture||w.isCompressedArrayTexture)&&(it=i.TEXTURE_2D_ARRAY),w.isData3DTexture&&(it=i.TEXTURE_3D);const ht=xt(L,w),nt=w.source;e.bindTexture(it,L.__webglTexture,i.TEXTURE0+V);const It=n.get(nt);if(nt.version!==It.__version||ht===!0){e.activeTexture(i.TEXTURE0+V);const wt=ye.getPrimaries(ye.workingColorSpace),Ut=w.colorSpace===es?null:ye.getPrimaries(w.colorSpace),re=w.colorSpace===es||wt===Ut?i.NONE:i.BROWSER_DEFAULT_WEBGL;i.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,w.flipY),i.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,w.premultiplyAlpha),i.pixelStorei(i.UNPACK_ALIGNMENT,w.unpackAlignment),i.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,re);let mt=M(w.image,!1,s.maxTextureSize);mt=Et(w,mt);const Rt=r.convert(w.format,w.colorSpace),jt=r.convert(w.type);let $t=C(w.internalFormat,Rt,jt,w.colorSpace,w.isVideoTexture);gt(it,w);let Lt;const ne=w.mipmaps,Qt=w.isVideoTexture!==!0,pe=It.__version===void 0||ht===!0,q=nt.dataReady,Tt=R(w,mt);if(w.isDepthTexture)$t=b(w.format===Lr,w.type),pe&&(Qt?e.texStorage2D(i.TEXTURE_2D,1,$t,mt.width,mt.height):e.texImage2D(i.TEXTURE_2D,0,$t,mt.width,mt.height,0,Rt,jt,null));else if(w.isDataTexture)if(ne.length>0){Qt&&pe&&e.texStorage2D(i.TEXTURE_2D,Tt,$t,ne[0].width,ne[0].height);for(let lt=0,ft=ne.length;lt<ft;lt++)Lt=ne[lt],Qt?q&&e.texSubImage2D(i.TEXTURE_2D,lt,0,0,Lt.width,Lt.height,Rt,jt,Lt.data):e.texImage2D(i.TEXTURE_2D,lt,$t,Lt.width,Lt.height,0,Rt,jt,Lt.data);w.generateMipmaps=!1}else Qt?(pe&&e.texStorage2D(i.TEXTURE_2D,Tt,$t,mt.width,mt.height),q&&e.texSubImage2D(i.TEXTURE_2D,0,0,0,mt.width,mt.height,Rt,jt,mt.data)):e.texImage2D(i.TEXTURE_2D,0,$t,mt.width,mt.height,0,Rt,jt,mt.data);else if(w.isCompressedTexture)if(w.isCompressedArrayTexture){Qt&&pe&&e.texStorage3D(i.TEXTURE_2D_ARRAY,Tt,$t,ne[0].width,ne[0].height,mt.depth);for(let lt=0,ft=ne.length;lt<ft;lt++)if(Lt=ne[lt],w.format!==ui)if(Rt!==null)if(Qt){if(q)if(w.layerUpdates.size>0){const Nt=vf(Lt.width,Lt.height,w.format,w.type);for(const Bt of w.layerUpdates){const fe=Lt.data.subarray(Bt*Nt/Lt.data.BYTES_PER_ELEMENT,(Bt+1)*Nt/Lt.data.BYTES_PER_ELEMENT);e.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,lt,0,0,Bt,Lt.width,Lt.height,1,Rt,fe,0,0)}w.clearLayerUpdates()}else e.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,lt,0,0,0,Lt.width,Lt.height,mt.depth,Rt,Lt.data,0,0)}else e.compressedTexImage3D(i.TEXTURE_2D_ARRAY,lt,$t,Lt.width,Lt.height,mt.depth,0,Lt.data,0,0);else console.warn("THREE.WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()");else Qt?q&&e.texSubImage3D(i.TEXTURE_2D_ARRAY,lt,0,0,0,Lt.width,Lt.height,mt.depth,Rt,jt,Lt.data):e.texImage3D(i.TEXTURE_2D_ARRAY,lt,$t,Lt.width,Lt.height,mt.depth,0,Rt,jt,Lt.data)}else{Qt&&pe&&e.texStorage2D(i.TEXTURE_2D,Tt,$t,ne[0].width,ne[0].height);for(let lt=0,ft=ne.length;lt<ft;lt++)Lt=ne[lt],w.format!==ui?Rt!==null?Qt?q&&e.compressedTexSubImage2D(i.TEXTURE_2D,lt,0,0,Lt.width,Lt.height,Rt,Lt.data):e.compressedTexImage2D(i.TEXTURE_2D,lt,$t,Lt.width,Lt.height,0,Lt.data):console.warn("THREE.WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()"):Qt?q&&e.texSubImage2D(i.TEXTURE_2D,lt,0,0,Lt.width,Lt.height,Rt,jt,Lt.data):e.texImage2D(i.TEXTURE_2D,lt,$t,Lt.width,Lt.height,0,Rt,jt,Lt.data)}else if(w.isDataArrayTexture)if(Qt){if(pe&&e.texStorage3D(i.TEXTURE_2D_ARRAY,Tt,$t,mt.width,mt.height,mt.depth),q)if(w.layerUpdates.size>0){const lt=vf(mt.width,mt.height,w.format,w.type);for(const ft of w.layerUpdates){const Nt=mt.data.subarray(ft*lt/mt.data.BYTES_PER_ELEMENT,(ft+1)*lt/mt.data.BYTES_PER_ELEMENT);e.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,ft,mt.width,mt.height,1,Rt,jt,Nt)}w.clearLayerUpdates()}else e.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,0,mt.width,mt.height,mt.depth,Rt,jt,mt.data)}else e.texImage3D(i.TEXTURE_2D_ARRAY,0,$t,mt.width,mt.height,mt.depth,0,Rt,jt,mt.data);else if(w.isData3DTexture)Qt?(pe&&e.texStorage3D(i.TEXTURE_3D,Tt,$t,mt.width,mt.height,mt.depth),q&&e.texSubImage3D(i.TEXTURE_3D,0,0,0,0,mt.width,mt.height,mt.depth,Rt,jt,mt.data)):e.texImage3D(i.TEXTURE_3D,0,$t,mt.width,mt.height,mt.depth,0,Rt,jt,mt.data);else if(w.isFramebufferTexture){if(pe)if(Qt)e.texStorage2D(i.TEXTURE_2D,Tt,$t,mt.width,mt.height);else{let lt=mt.width,ft=mt.height;for(let Nt=0;Nt<Tt;Nt++)e.texImage2D(i.TEXTURE_2D,Nt,$t,lt,ft,0,Rt,jt,null),lt>>=1,ft>>=1}}else if(ne.length>0){if(Qt&&pe){const lt=Xt(ne[0]);e.texStorage2D(i.TEXTURE_2D,Tt,$t,lt.width,lt.height)}for(let lt=0,ft=ne.length;lt<ft;lt++)Lt=ne[lt],Qt?q&&e.texSubImage2D(i.TEXTURE_2D,lt,0,0,Rt,jt,Lt):e.texImage2D(i.TEXTURE_2D,lt,$t,Rt,jt,Lt);w.generateMipmaps=!1}else if(Qt){if(pe){const lt=Xt(mt);e.texStorage2D(i.TEXTURE_2D,Tt,$t,lt.width,lt.height)}q&&e.texSubImage2D(i.TEXTURE_2D,0,0,0,Rt,jt,mt)}else e.texImage2D(i.TEXTURE_2D,0,$t,Rt,jt,mt);p(w)&&d(it),It.__version=nt.version,w.onUpdate&&w.onUpdate(w)}L.__version=w.version}function rt(L,w,V){if(w.image.length!==6)return;const it=xt(L,w),ht=w.source;e.bindTexture(i.TEXTURE_CUBE_MAP,L.__webglTexture,i.TEXTURE0+V);const nt=n.get(ht);if(ht.version!==nt.__version||it===!0){e.activeTexture(i.TEXTURE0+V);const It=ye.getPrimaries(ye.workingColorSpace),wt=w.colorSpace===es?null:ye.getPrimaries(w.colorSpace),Ut=w.colorSpace===es||It===wt?i.NONE:i.BROWSER_DEFAULT_WEBGL;i.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,w.flipY),i.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,w.premultiplyAlpha),i.pixelStorei(i.UNPACK_ALIGNMENT,w.unpackAlignment),i.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,Ut);const re=w.isCompressedTexture||w.image[0].isCompressedTexture,mt=w.image[0]&&w.image[0].isDataTexture,Rt=[];for(let ft=0;ft<6;ft++)!re&&!mt?Rt[ft]=M(w.image[ft],!0,s.maxCubemapSize):Rt[ft]=mt?w.image[ft].image:w.image[ft],Rt[ft]=Et(w,Rt[ft]);const jt=Rt[0],$t=r.convert(w.format,w.colorSpace),Lt=r.convert(w.type),ne=C(w.internalFormat,$t,Lt,w.colorSpace),Qt=w.isVideoTexture!==!0,pe=nt.__version===void 0||it===!0,q=ht.dataReady;let Tt=R(w,jt);gt(i.TEXTURE_CUBE_MAP,w);let lt;if(re){Qt&&pe&&e.texStorage2D(i.TEXTURE_CUBE_MAP,Tt,ne,jt.width,jt.height);for(let ft=0;ft<6;ft++){lt=Rt[ft].mipmaps;for(let Nt=0;Nt<lt.length;Nt++){const Bt=lt[Nt];w.format!==ui?$t!==null?Qt?q&&e.compressedTexSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ft,Nt,0,0,Bt.width,Bt.height,$t,Bt.data):e.compressedTexImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ft,Nt,ne,Bt.width,Bt.height,0,Bt.data):console.warn("THREE.WebGLRenderer: Attempt to load unsupported compressed texture format in .setTextureCube()"):Qt?q&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ft,Nt,0,0,Bt.width,Bt.height,$t,Lt,Bt.data):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ft,Nt,ne,Bt.width,Bt.height,0,$t,Lt,Bt.data)}}}else{if(lt=w.mipmaps,Qt&&pe){lt.length>0&&Tt++;const ft=Xt(Rt[0]);e.texStorage2D(i.TEXTURE_CUBE_MAP,Tt,ne,ft.width,ft.height)}for(let ft=0;ft<6;ft++)if(mt){Qt?q&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ft,0,0,0,Rt[ft].width,Rt[ft].height,$t,Lt,Rt[ft].data):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ft,0,ne,Rt[ft].width,Rt[ft].height,0,$t,Lt,Rt[ft].data);for(let Nt=0;Nt<lt.length;Nt++){const fe=lt[Nt].image[ft].image;Qt?q&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ft,Nt+1,0,0,fe.width,fe.height,$t,Lt,fe.data):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ft,Nt+1,ne,fe.width,fe.height,0,$t,Lt,fe.data)}}else{Qt?q&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ft,0,0,0,$t,Lt,Rt[ft]):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ft,0,ne,$t,Lt,Rt[ft]);for(let Nt=0;Nt<lt.length;Nt++){const Bt=lt[Nt];Qt?q&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ft,Nt+1,0,0,$t,Lt,Bt.image[ft]):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ft,Nt+1,ne,$t,Lt,Bt.image[ft])}}}p(w)&&d(i.TEXTURE_CUBE_MAP),nt.__version=ht.version,w.onUpdate&&w.onUpdate(w)}L.__version=w.version}function pt(L,w,V,it,ht,nt){const It=r.convert(V.format,V.colorSpace),wt=r.convert(V.type),Ut=C(V.internalFormat,It,wt,V.colorSpace);if(!n.get(w).__hasExternalTextures){const mt=Math.max(1,w.width>>nt),Rt=Math.max(1,w.height>>nt);ht===i.TEXTURE_3D||ht===i.TEXTURE_2D_ARRAY?e.texImage3D(ht,nt,Ut,mt,Rt,w.depth,0,It,wt,null):e.texImage2D(ht,nt,Ut,mt,Rt,0,It,wt,null)}e.bindFramebuffer(i.FRAMEBUFFER,L),Ht(w)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,it,ht,n.get(V).__webglTexture,0,Mt(w)):(ht===i.TEXTURE_2D||ht>=i.TEXTURE_CUBE_MAP_POSITIVE_X&&ht<=i.TEXTURE_CUBE_MAP_NEGATIVE_Z)&&i.framebufferTexture2D(i.FRAMEBUFFER,it,ht,n.get(V).__webglTexture,nt),e.bindFramebuffer(i.FRAMEBUFFER,null)}function Dt(L,w,V){if(i.bindRenderbuffer(i.RENDERBUFFER,L),w.depthBuffer){const it=w.depthTexture,ht=it&&it.isDepthTexture?it.type:null,nt=b(w.stencilBuffer,ht),It=w.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,wt=Mt(w);Ht(w)?a.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,wt,nt,w.width,w.height):V?i.renderbufferStorageMultisample(i.RENDERBUFFER,wt,nt,w.width,w.height):i.renderbufferStorage(i.RENDERBUFFER,nt,w.width,w.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,It,i.RENDERBUFFER,L)}else{const it=w.textures;for(let ht=0;ht<it.length;ht++){const nt=it[ht],It=r.convert(nt.format,nt.colorSpace),wt=r.convert(nt.type),Ut=C(nt.internalFormat,It,wt,nt.colorSpace),re=Mt(w);V&&Ht(w)===!1?i.renderbufferStorageMultisample(i.RENDERBUFFER,re,Ut,w.width,w.height):Ht(w)?a.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,re,Ut,w.width,w.height):i.renderbufferStorage(i.RENDERBUFFER,Ut,w.width,w.height)}}i.bindRenderbuffer(i.RENDERBUFFER,null)}function St(L,w){if(w&&w.isWebGLCubeRenderTarget)throw new Error("Depth Texture with cube render targets is not supported");if(e.bindFramebuffer(i.FRAMEBUFFER,L),!(w.depthTexture&&w.depthTexture.isDepthTexture))throw new Error("renderTarget.depthTexture must be an instance of THREE.DepthTexture");(!n.get(w.depthTexture).__webglTexture||w.depthTexture.image.width!==w.width||w.depthTexture.image.height!==w.height)&&(w.depthTexture.image.width=w.width,w.depthTexture.image.height=w.height,w.depthTexture.needsUpdate=!0),F(w.depthTexture,0);const it=n.get(w.depthTexture).__webglTexture,ht=Mt(w);if(w.depthTexture.format===wr)Ht(w)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,i.DEPTH_ATTACHMENT,i.TEXTURE_2D,it,0,ht):i.framebufferTexture2D(i.FRAMEBUFFER,i.DEPTH_ATTACHMENT,i.TEXTURE_2D,it,0);else if(w.depthTexture.format===Lr)Ht(w)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,i.DEPTH_STENCIL_ATTACHMENT,i.TEXTURE_2D,it,0,ht):i.framebufferTexture2D(i.FRAMEBUFFER,i.DEPTH_STENCIL_ATTACHMENT,i.TEXTURE_2D,it,0);else throw new Error("Unknown depthTexture format")}function Z(L){const w=n.get(L),V=L.isWebGLCubeRenderTarget===!0;if(w.__boundDepthTexture!==L.depthTexture){const it=L.depthTexture;if(w.__depthDisposeCallback&&w.__depthDisposeCallback(),it){const ht=()=>{delete w.__boundDepthTexture,delete w.__depthDisposeCallback,it.removeEventListener("dispose",ht)};it.addEventListener("dispose",ht),w.__depthDisposeCallback=ht}w.__boundDepthTexture=it}if(L.depthTexture&&!w.__autoAllocateDepthBuffer){if(V)throw new Error("target.depthTexture not supported in Cube render targets");St(w.__webglFramebuffer,L)}else if(V){w.__webglDepthbuffer=[];for(let it=0;it<6;it++)if(e.bindFramebuffer(i.FRAMEBUFFER,w.__webglFramebuffer[it]),w.__webglDepthbuffer[it]===void 0)w.__webglDepthbuffer[it]=i.createRenderbuffer(),Dt(w.__webglDepthbuffer[it],L,!1);else{const ht=L.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,nt=w.__webglDepthbuffer[it];i.bindRenderbuffer(i.RENDERBUFFER,nt),i.framebufferRenderbuffer(i.FRAMEBUFFER,ht,i.RENDERBUFFER,nt)}}else if(e.bindFramebuffer(i.FRAMEBUFFER,w.__webglFramebuffer),w.__webglDepthbuffer===void 0)w.__webglDepthbuffer=i.createRenderbuffer(),Dt(w.__webglDepthbuffer,L,!1);else{const it=L.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,ht=w.__webglDepthbuffer;i.bindRenderbuffer(i.RENDERBUFFER,ht),i.framebufferRenderbuffer(i.FRAMEBUFFER,it,i.RENDERBUFFER,ht)}e.bindFramebuffer(i.FRAMEBUFFER,null)}function J(L,w,V){const it=n.get(L);w!==void 0&&pt(it.__webglFramebuffer,L,L.texture,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,0),V!==void 0&&Z(L)}function Y(L){const w=L.texture,V=n.get(L),it=n.get(w);L.addEventListener("dispose",A);const ht=L.textures,nt=L.isWebGLCubeRenderTarget===!0,It=ht.length>1;if(It||(it.__webglTexture===void 0&&(it.__webglTexture=i.createTexture()),it.__version=w.version,o.memory.textures++),nt){V.__webglFramebuffer=[];for(let wt=0;wt<6;wt++)if(w.mipmaps&&w.mipmaps.length>0){V.__webglFramebuffer[wt]=[];for(let Ut=0;Ut<w.mipmaps.length;Ut++)V.__webglFramebuffer[wt][Ut]=i.createFramebuffer()}else V.__webglFramebuffer[wt]=i.createFramebuffer()}else{if(w.mipmaps&&w.mipmaps.length>0){V.__webglFramebuffer=[];for(let wt=0;wt<w.mipmaps.length;wt++)V.__webglFramebuffer[wt]=i.createFramebuffer()}else V.__webglFramebuffer=i.createFramebuffer();if(It)for(let wt=0,Ut=ht.length;wt<Ut;wt++){const re=n.get(ht[wt]);re.__webglTexture===void 0&&(re.__webglTexture=i.createTexture(),o.memory.textures++)}if(L.samples>0&&Ht(L)===!1){V.__webglMultisampledFramebuffer=i.createFramebuffer(),V.__webglColorRenderbuffer=[],e.bindFramebuffer(i.FRAMEBUFFER,V.__webglMultisampledFramebuffer);for(let wt=0;wt<ht.length;wt++){const Ut=ht[wt];V.__webglColorRenderbuffer[wt]=i.createRenderbuffer(),i.bindRenderbuffer(i.RENDERBUFFER,V.__webglColorRenderbuffer[wt]);const re=r.convert(Ut.format,Ut.colorSpace),mt=r.convert(Ut.type),Rt=C(Ut.internalFormat,re,mt,Ut.colorSpace,L.isXRRenderTarget===!0),jt=Mt(L);i.renderbufferStorageMultisample(i.RENDERBUFFER,jt,Rt,L.width,L.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+wt,i.RENDERBUFFER,V.__webglColorRenderbuffer[wt])}i.bindRenderbuffer(i.RENDERBUFFER,null),L.depthBuffer&&(V.__webglDepthRenderbuffer=i.createRenderbuffer(),Dt(V.__webglDepthRenderbuffer,L,!0)),e.bindFramebuffer(i.FRAMEBUFFER,null)}}if(nt){e.bindTexture(i.TEXTURE_CUBE_MAP,it.__webglTexture),gt(i.TEXTURE_CUBE_MAP,w);for(let wt=0;wt<6;wt++)if(w.mipmaps&&w.mipmaps.length>0)for(let Ut=0;Ut<w.mipmaps.length;Ut++)pt(V.__webglFramebuffer[wt][Ut],L,w,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+wt,Ut);else pt(V.__webglFramebuffer[wt],L,w,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+wt,0);p(w)&&d(i.TEXTURE_CUBE_MAP),e.unbindTexture()}else if(It){for(let wt=0,Ut=ht.length;wt<Ut;wt++){const re=ht[wt],mt=n.get(re);e.bindTexture(i.TEXTURE_2D,mt.__webglTexture),gt(i.TEXTURE_2D,re),pt(V.__webglFramebuffer,L,re,i.COLOR_ATTACHMENT0+wt,i.TEXTURE_2D,0),p(re)&&d(i.TEXTURE_2D)}e.unbindTexture()}else{let wt=i.TEXTURE_2D;if((L.isWebGL3DRenderTarget||L.isWebGLArrayRenderTarget)&&(wt=L.isWebGL3DRenderTarget?i.TEXTURE_3D:i.TEXTURE_2D_ARRAY),e.bindTexture(wt,it.__webglTexture),gt(wt,w),w.mipmaps&&w.mipmaps.length>0)for(let Ut=0;Ut<w.mipmaps.length;Ut++)pt(V.__webglFramebuffer[Ut],L,w,i.COLOR_ATTACHMENT0,wt,Ut);else pt(V.__webglFramebuffer,L,w,i.COLOR_ATTACHMENT0,wt,0);p(w)&&d(wt),e.unbindTexture()}L.depthBuffer&&Z(L)}function ot(L){const w=L.textures;for(let V=0,it=w.length;V<it;V++){const ht=w[V];if(p(ht)){const nt=L.isWebGLCubeRenderTarget?i.TEXTURE_CUBE_MAP:i.TEXTURE_2D,It=n.get(ht).__webglTexture;e.bindTexture(nt,It),d(nt),e.unbindTexture()}}}const at=[],I=[];function Ot(L){if(L.samples>0){if(Ht(L)===!1){const w=L.textures,V=L.width,it=L.height;let ht=i.COLOR_BUFFER_BIT;const nt=L.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,It=n.get(L),wt=w.length>1;if(wt)for(let Ut=0;Ut<w.length;Ut++)e.bindFramebuffer(i.FRAMEBUFFER,It.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+Ut,i.RENDERBUFFER,null),e.bindFramebuffer(i.FRAMEBUFFER,It.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+Ut,i.TEXTURE_2D,null,0);e.bindFramebuffer(i.READ_FRAMEBUFFER,It.__webglMultisampledFramebuffer),e.bindFramebuffer(i.DRAW_FRAMEBUFFER,It.__webglFramebuffer);for(let Ut=0;Ut<w.length;Ut++){if(L.resolveDepthBuffer&&(L.depthBuffer&&(ht|=i.DEPTH_BUFFER_BIT),L.stencilBuffer&&L.resolveStencilBuffer&&(ht|=i.STENCIL_BUFFER_BIT)),wt){i.framebufferRenderbuffer(i.READ_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.RENDERBUFFER,It.__webglColorRenderbuffer[Ut]);const re=n.get(w[Ut]).__webglTexture;i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,re,0)}i.blitFramebuffer(0,0,V,it,0,0,V,it,ht,i.NEAREST),l===!0&&(at.length=0,I.length=0,at.push(i.COLOR_ATTACHMENT0+Ut),L.depthBuffer&&L.resolveDepthBuffer===!1&&(at.push(nt),I.push(nt),i.invalidateFramebuffer(i.DRAW_FRAMEBUFFER,I)),i.invalidateFramebuffer(i.READ_FRAMEBUFFER,at))}if(e.bindFramebuffer(i.READ_FRAMEBUFFER,null),e.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),wt)for(let Ut=0;Ut<w.length;Ut++){e.bindFramebuffer(i.FRAMEBUFFER,It.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+Ut,i.RENDERBUFFER,It.__webglColorRenderbuffer[Ut]);const re=n.get(w[Ut]).__webglTexture;e.bindFramebuffer(i.FRAMEBUFFER,It.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+Ut,i.TEXTURE_2D,re,0)}e.bindFramebuffer(i.DRAW_FRAMEBUFFER,It.__webglMultisampledFramebuffer)}else if(L.depthBuffer&&L.resolveDepthBuffer===!1&&l){const w=L.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;i.invalidateFramebuffer(i.DRAW_FRAMEBUFFER,[w])}}}function Mt(L){return Math.min(s.maxSamples,L.samples)}function Ht(L){const w=n.get(L);return L.samples>0&&t.has("WEBGL_multisampled_render_to_texture")===!0&&w.__useRenderToTexture!==!1}function At(L){const w=o.render.frame;u.get(L)!==w&&(u.set(L,w),L.update())}function Et(L,w){const V=L.colorSpace,it=L.format,ht=L.type;return L.isCompressedTexture===!0||L.isVideoTexture===!0||V!==fs&&V!==es&&(ye.getTransfer(V)===Oe?(it!==ui||ht!==Hi)&&console.warn("THREE.WebGLTextures: sRGB encoded textures have to use RGBAFormat and UnsignedByteType."):console.error("THREE.WebGLTextures: Unsupported texture color space:",V)),w}function Xt(L){return typeof HTMLImageElement<"u"&&L instanceof HTMLImageElement?(c.width=L.naturalWidth||L.width,c.height=L.naturalHeight||L.height):typeof VideoFrame<"u"&&L instanceof VideoFrame?(c.width=L.displayWidth,c.height=L.displayHeight):(c.width=L.width,c.height=L.height),c}this.allocateTextureUnit=E,this.resetTextureUnits=m,this.setTexture2D=F,this.setTexture2DArray=B,this.setTexture3D=G,this.setTextureCube=K,this.rebindTextures=J,this.setupRenderTarget=Y,this.updateRenderTargetMipmap=ot,this.updateMultisampleRenderTarget=Ot,this.setupDepthRenderbuffer=Z,this.setupFrameBufferTexture=pt,this.useMultisampledRTT=Ht}function vy(i,t){function e(n,s=es){let r;const o=ye.getTransfer(s);if(n===Hi)return i.UNSIGNED_BYTE;if(n===vh)return i.UNSIGNED_SHORT_4_4_4_4;if(n===xh)return i.UNSIGNED_SHORT_5_5_5_1;if(n===zd)return i.UNSIGNED_INT_5_9_9_9_REV;if(n===Fd)return i.BYTE;if(n===Bd)return i.SHORT;if(n===Mo)return i.UNSIGNED_SHORT;if(n===_h)return i.INT;if(n===Ns)return i.UNSIGNED_INT;if(n===Oi)return i.FLOAT;if(n===wo)return i.HALF_FLOAT;if(n===Hd)return i.ALPHA;if(n===Gd)return i.RGB;if(n===ui)return i.RGBA;if(n===Vd)return i.LUMINANCE;if(n===Wd)return i.LUMINANCE_ALPHA;if(n===wr)return i.DEPTH_COMPONENT;if(n===Lr)return i.DEPTH_STENCIL;if(n===Xd)return i.RED;if(n===Mh)return i.RED_INTEGER;if(n===qd)return i.RG;if(n===yh)return i.RG_INTEGER;if(n===Sh)return i.RGBA_INTEGER;if(n===xa||n===Ma||n===ya||n===Sa)if(o===Oe)if(r=t.get("WEBGL_compressed_texture_s3tc_srgb"),r!==null){if(n===xa)return r.COMPRESSED_SRGB_S3TC_DXT1_EXT;if(n===Ma)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT;if(n===ya)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT;if(n===Sa)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT}else return null;else if(r=t.get("WEBGL_compressed_texture_s3tc"),r!==null){if(n===xa)return r.COMPRESSED_RGB_S3TC_DXT1_EXT;if(n===Ma)return r.COMPRESSED_RGBA_S3TC_DXT1_EXT;if(n===ya)return r.COMPRESSED_RGBA_S3TC_DXT3_EXT;if(n===Sa)return r.COMPRESSED_RGBA_S3TC_DXT5_EXT}else return null;if(n===Tc||n===Ac||n===Rc||n===Cc)if(r=t.get("WEBGL_compressed_texture_pvrtc"),r!==null){if(n===Tc)return r.COMPRESSED_RGB_PVRTC_4BPPV1_IMG;if(n===Ac)return r.COMPRESSED_RGB_PVRTC_2BPPV1_IMG;if(n===Rc)return r.COMPRESSED_RGBA_PVRTC_4BPPV1_IMG;if(n===Cc)return r.COMPRESSED_RGBA_PVRTC_2BPPV1_IMG}else return null;if(n===Pc||n===Lc||n===Dc)if(r=t.get("WEBGL_compressed_texture_etc"),r!==null){if(n===Pc||n===Lc)return o===Oe?r.COMPRESSED_SRGB8_ETC2:r.COMPRESSED_RGB8_ETC2;if(n===Dc)return o===Oe?r.COMPRESSED_SRGB8_ALPHA8_ETC2_EAC:r.COMPRESSED_RGBA8_ETC2_EAC}else return null;if(n===Ic||n===Uc||n===Nc||n===kc||n===Oc||n===Fc||n===Bc||n===zc||n===Hc||n===Gc||n===Vc||n===Wc||n===Xc||n===qc)if(r=t.get("WEBGL_compressed_texture_astc"),r!==null){if(n===Ic)return o===Oe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_4x4_KHR:r.COMPRESSED_RGBA_ASTC_4x4_KHR;if(n===Uc)return o===Oe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x4_KHR:r.COMPRESSED_RGBA_ASTC_5x4_KHR;if(n===Nc)return o===Oe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x5_KHR:r.COMPRESSED_RGBA_ASTC_5x5_KHR;if(n===kc)return o===Oe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x5_KHR:r.COMPRESSED_RGBA_ASTC_6x5_KHR;if(n===Oc)return o===Oe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x6_KHR:r.COMPRESSED_RGBA_ASTC_6x6_KHR;if(n===Fc)return o===Oe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x5_KHR:r.COMPRESSED_RGBA_ASTC_8x5_KHR;if(n===Bc)return o===Oe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x6_KHR:r.COMPRESSED_RGBA_ASTC_8x6_KHR;if(n===zc)return o===Oe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x8_KHR:r.COMPRESSED_RGBA_ASTC_8x8_KHR;if(n===Hc)return o===Oe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x5_KHR:r.COMPRESSED_RGBA_ASTC_10x5_KHR;if(n===Gc)return o===Oe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x6_KHR:r.COMPRESSED_RGBA_ASTC_10x6_KHR;if(n===Vc)return o===Oe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x8_KHR:r.COMPRESSED_RGBA_ASTC_10x8_KHR;if(n===Wc)return o===Oe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x10_KHR:r.COMPRESSED_RGBA_ASTC_10x10_KHR;if(n===Xc)return o===Oe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x10_KHR:r.COMPRESSED_RGBA_ASTC_12x10_KHR;if(n===qc)return o===Oe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x12_KHR:r.COMPRESSED_RGBA_ASTC_12x12_KHR}else return null;if(n===Ea||n===Yc||n===jc)if(r=t.get("EXT_texture_compression_bptc"),r!==null){if(n===Ea)return o===Oe?r.COMPRESSED_SRGB_ALPHA_BPTC_UNORM_EXT:r.COMPRESSED_RGBA_BPTC_UNORM_EXT;if(n===Yc)return r.COMPRESSED_RGB_BPTC_SIGNED_FLOAT_EXT;if(n===jc)return r.COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_EXT}else return null;if(n===Yd||n===Kc||n===$c||n===Zc)if(r=t.get("EXT_texture_compression_rgtc"),r!==null){if(n===Ea)return r.COMPRESSED_RED_RGTC1_EXT;if(n===Kc)return r.COMPRESSED_SIGNED_RED_RGTC1_EXT;if(n===$c)return r.COMPRESSED_RED_GREEN_RGTC2_EXT;if(n===Zc)return r.COMPRESSED_SIGNED_RED_GREEN_RGTC2_EXT}else return null;return n===Pr?i.UNSIGNED_INT_24_8:i[n]!==void 0?i[n]:null}return{convert:e}}class xy extends $n{constructor(t=[]){super(),this.isArrayCamera=!0,this.cameras=t}}class fi extends fn{constructor(){super(),this.isGroup=!0,this.type="Group"}}const My={type:"move"};class ql{constructor(){this._targetRay=null,this._grip=null,this._hand=null}getHandSpace(){return this._hand===null&&(this._hand=new fi,this._hand.matrixAutoUpdate=!1,this._hand.visible=!1,this._hand.joints={},this._hand.inputState={pinching:!1}),this._hand}getTargetRaySpace(){return this._targetRay===null&&(this._targetRay=new fi,this._targetRay.matrixAutoUpdate=!1,this._targetRay.visible=!1,this._targetRay.hasLinearVelocity=!1,this._targetRay.linearVelocity=new $,this._targetRay.hasAngularVelocity=!1,this._targetRay.angularVelocity=new $),this._targetRay}getGripSpace(){return this._grip===null&&(this._grip=new fi,this._grip.matrixAutoUpdate=!1,this._grip.visible=!1,this._grip.hasLinearVelocity=!1,this._grip.linearVelocity=new $,this._grip.hasAngularVelocity=!1,this._grip.angularVelocity=new $),this._grip}dispatchEvent(t){return this._targetRay!==null&&this._targetRay.dispatchEvent(t),this._grip!==null&&this._grip.dispatchEvent(t),this._hand!==null&&this._hand.dispatchEvent(t),this}connect(t){if(t&&t.hand){const e=this._hand;if(e)for(const n of t.hand.values())this._getHandJoint(e,n)}return this.dispatchEvent({type:"connected",data:t}),this}disconnect(t){return this.dispatchEvent({type:"disconnected",data:t}),this._targetRay!==null&&(this._targetRay.visible=!1),this._grip!==null&&(this._grip.visible=!1),this._hand!==null&&(this._hand.visible=!1),this}update(t,e,n){let s=null,r=null,o=null;const a=this._targetRay,l=this._grip,c=this._hand;if(t&&e.session.visibilityState!=="visible-blurred"){if(c&&t.hand){o=!0;for(const M of t.hand.values()){const p=e.getJointPose(M,n),d=this._getHandJoint(c,M);p!==null&&(d.matrix.fromArray(p.transform.matrix),d.matrix.decompose(d.position,d.rotation,d.scale),d.matrixWorldNeedsUpdate=!0,d.jointRadius=p.radius),d.visible=p!==null}const u=c.joints["index-finger-tip"],f=c.joints["thumb-tip"],h=u.position.distanceTo(f.position),_=.02,x=.005;c.inputState.pinching&&h>_+x?(c.inputState.pinching=!1,this.dispatchEvent({type:"pinchend",handedness:t.handedness,target:this})):!c.inputState.pinching&&h<=_-x&&(c.inputState.pinching=!0,this.dispatchEvent({type:"pinchstart",handedness:t.handedness,target:this}))}else l!==null&&t.gripSpace&&(r=e.getPose(t.gripSpace,n),r!==null&&(l.matrix.fromArray(r.transform.matrix),l.matrix.decompose(l.position,l.rotation,l.scale),l.matrixWorldNeedsUpdate=!0,r.linearVelocity?(l.hasLinearVelocity=!0,l.linearVelocity.copy(r.linearVelocity)):l.hasLinearVelocity=!1,r.angularVelocity?(l.hasAngularVelocity=!0,l.angularVelocity.copy(r.angularVelocity)):l.hasAngularVelocity=!1));a!==null&&(s=e.getPose(t.targetRaySpace,n),s===null&&r!==null&&(s=r),s!==null&&(a.matrix.fromArray(s.transform.matrix),a.matrix.decompose(a.position,a.rotation,a.scale),a.matrixWorldNeedsUpdate=!0,s.linearVelocity?(a.hasLinearVelocity=!0,a.linearVelocity.copy(s.linearVelocity)):a.hasLinearVelocity=!1,s.angularVelocity?(a.hasAngularVelocity=!0,a.angularVelocity.copy(s.angularVelocity)):a.hasAngularVelocity=!1,this.dispatchEvent(My)))}return a!==null&&(a.visible=s!==null),l!==null&&(l.visible=r!==null),c!==null&&(c.visible=o!==null),this}_getHandJoint(t,e){if(t.joints[e.jointName]===void 0){const n=new fi;n.matrixAutoUpdate=!1,n.visible=!1,t.joints[e.jointName]=n,t.add(n)}return t.joints[e.jointName]}}const yy=`
void main() {

	gl_Position = vec4( position, 1.0 );

}`,Sy=`
uniform sampler2DArray depthColor;
uniform float depthWidth;
uniform float depthHeight;

void main() {

	vec2 coord = vec2( gl_FragCoord.x / depthWidth, gl_FragCoord.y / depthHeight );

	if ( coord.x >= 1.0 ) {

		gl_FragDepth = texture( depthColor, vec3( coord.x - 1.0, coord.y, 1 ) ).r;

	} else {

		gl_FragDepth = texture( depthColor, vec3( coord.x, coord.y, 0 ) ).r;

	}

}`;class Ey{constructor(){this.texture=null,this.mesh=null,this.depthNear=0,this.depthFar=0}init(t,e,n){if(this.texture===null){const s=new kn,r=t.properties.get(s);r.__webglTexture=e.texture,(e.depthNear!=n.depthNear||e.depthFar!=n.depthFar)&&(this.depthNear=e.depthNear,this.depthFar=e.depthFar),this.texture=s}}getMesh(t){if(this.texture!==null&&this.mesh===null){const e=t.cameras[0].viewport,n=new hs({vertexShader:yy,fragmentShader:Sy,uniforms:{depthColor:{value:this.texture},depthWidth:{value:e.z},depthHeight:{value:e.w}}});this.mesh=new sn(new Wa(20,20),n)}return this.mesh}reset(){this.texture=null,this.mesh=null}getDepthTexture(){return this.texture}}class wy extends Bs{constructor(t,e){super();const n=this;let s=null,r=1,o=null,a="local-floor",l=1,c=null,u=null,f=null,h=null,_=null,x=null;const M=new Ey,p=e.getContextAttributes();let d=null,C=null;const b=[],R=[],D=new se;let A=null;const y=new $n;y.layers.enable(1),y.viewport=new Ye;const P=new $n;P.layers.enable(2),P.viewport=new Ye;const O=[y,P],g=new xy;g.layers.enable(1),g.layers.enable(2);let m=null,E=null;this.cameraAutoUpdate=!0,this.enabled=!1,this.isPresenting=!1,this.getController=function(rt){let pt=b[rt];return pt===void 0&&(pt=new ql,b[rt]=pt),pt.getTargetRaySpace()},this.getControllerGrip=function(rt){let pt=b[rt];return pt===void 0&&(pt=new ql,b[rt]=pt),pt.getGripSpace()},this.getHand=function(rt){let pt=b[rt];return pt===void 0&&(pt=new ql,b[rt]=pt),pt.getHandSpace()};function N(rt){const pt=R.indexOf(rt.inputSource);if(pt===-1)return;const Dt=b[pt];Dt!==void 0&&(Dt.update(rt.inputSource,rt.frame,c||o),Dt.dispatchEvent({type:rt.type,data:rt.inputSource}))}function F(){s.removeEventListener("select",N),s.removeEventListener("selectstart",N),s.removeEventListener("selectend",N),s.removeEventListener("squeeze",N),s.removeEventListener("squeezestart",N),s.removeEventListener("squeezeend",N),s.removeEventListener("end",F),s.removeEventListener("inputsourceschange",B);for(let rt=0;rt<b.length;rt++){const pt=R[rt];pt!==null&&(R[rt]=null,b[rt].disconnect(pt))}m=null,E=null,M.reset(),t.setRenderTarget(d),_=null,h=null,f=null,s=null,C=null,Vt.stop(),n.isPresenting=!1,t.setPixelRatio(A),t.setSize(D.width,D.height,!1),n.dispatchEvent({type:"sessionend"})}this.setFramebufferScaleFactor=function(rt){r=rt,n.isPresenting===!0&&console.warn("THREE.WebXRManager: Cannot change framebuffer scale while presenting.")},this.setReferenceSpaceType=function(rt){a=rt,n.isPresenting===!0&&console.warn("THREE.WebXRManager: Cannot change reference space type while presenting.")},this.getReferenceSpace=function(){return c||o},this.setReferenceSpace=function(rt){c=rt},this.getBaseLayer=function(){return h!==null?h:_},this.getBinding=function(){return f},this.getFrame=function(){return x},this.getSession=function(){return s},this.setSession=async function(rt){if(s=rt,s!==null){if(d=t.getRenderTarget(),s.addEventListener("select",N),s.addEventListener("selectstart",N),s.addEventListener("selectend",N),s.addEventListener("squeeze",N),s.addEventListener("squeezestart",N),s.addEventListener("squeezeend",N),s.addEventListener("end",F),s.addEventListener("inputsourceschange",B),p.xrCompatible!==!0&&await e.makeXRCompatible(),A=t.getPixelRatio(),t.getSize(D),s.renderState.layers===void 0){const pt={antialias:p.antialias,alpha:!0,depth:p.depth,stencil:p.stencil,framebufferScaleFactor:r};_=new XRWebGLLayer(s,e,pt),s.updateRenderState({baseLayer:_}),t.setPixelRatio(1),t.setSize(_.framebufferWidth,_.framebufferHeight,!1),C=new ks(_.framebufferWidth,_.framebufferHeight,{format:ui,type:Hi,colorSpace:t.outputColorSpace,stencilBuffer:p.stencil})}else{let pt=null,Dt=null,St=null;p.depth&&(St=p.stencil?e.DEPTH24_STENCIL8:e.DEPTH_COMPONENT24,pt=p.stencil?Lr:wr,Dt=p.stencil?Pr:Ns);const Z={colorFormat:e.RGBA8,depthFormat:St,scaleFactor:r};f=new XRWebGLBinding(s,e),h=f.createProjectionLayer(Z),s.updateRenderState({layers:[h]}),t.setPixelRatio(1),t.setSize(h.textureWidth,h.textureHeight,!1),C=new ks(h.textureWidth,h.textureHeight,{format:ui,type:Hi,depthTexture:new lp(h.textureWidth,h.textureHeight,Dt,void 0,void 0,void 0,void 0,void 0,void 0,pt),stencilBuffer:p.stencil,colorSpace:t.outputColorSpace,samples:p.antialias?4:0,resolveDepthBuffer:h.ignoreDepthValues===!1})}C.isXRRenderTarget=!0,this.setFoveation(l),c=null,o=await s.requestReferenceSpace(a),Vt.setContext(s),Vt.start(),n.isPresenting=!0,n.dispatchEvent({type:"sessionstart"})}},this.getEnvironmentBlendMode=function(){if(s!==null)return s.environmentBlendMode},this.getDepthTexture=function(){return M.getDepthTexture()};function B(rt){for(let pt=0;pt<rt.removed.length;pt++){const Dt=rt.removed[pt],St=R.indexOf(Dt);St>=0&&(R[St]=null,b[St].disconnect(Dt))}for(let pt=0;pt<rt.added.length;pt++){const Dt=rt.added[pt];let St=R.indexOf(Dt);if(St===-1){for(let J=0;J<b.length;J++)if(J>=R.length){R.push(Dt),St=J;break}else if(R[J]===null){R[J]=Dt,St=J;break}if(St===-1)break}const Z=b[St];Z&&Z.connect(Dt)}}const G=new $,K=new $;function Q(rt,pt,Dt){G.setFromMatrixPosition(pt.matrixWorld),K.setFromMatrixPosition(Dt.matrixWorld);const St=G.distanceTo(K),Z=pt.projectionMatrix.elements,J=Dt.projectionMatrix.elements,Y=Z[14]/(Z[10]-1),ot=Z[14]/(Z[10]+1),at=(Z[9]+1)/Z[5],I=(Z[9]-1)/Z[5],Ot=(Z[8]-1)/Z[0],Mt=(J[8]+1)/J[0],Ht=Y*Ot,At=Y*Mt,Et=St/(-Ot+Mt),Xt=Et*-Ot;if(pt.matrixWorld.decompose(rt.position,rt.quaternion,rt.scale),rt.translateX(Xt),rt.translateZ(Et),rt.matrixWorld.compose(rt.position,rt.quaternion,rt.scale),rt.matrixWorldInverse.copy(rt.matrixWorld).invert(),Z[10]===-1)rt.projectionMatrix.copy(pt.projectionMatrix),rt.projectionMatrixInverse.copy(pt.projectionMatrixInverse);else{const L=Y+Et,w=ot+Et,V=Ht-Xt,it=At+(St-Xt),ht=at*ot/w*L,nt=I*ot/w*L;rt.projectionMatrix.makePerspective(V,it,ht,nt,L,w),rt.projectionMatrixInverse.copy(rt.projectionMatrix).invert()}}function dt(rt,pt){pt===null?rt.matrixWorld.copy(rt.matrix):rt.matrixWorld.multiplyMatrices(pt.matrixWorld,rt.matrix),rt.matrixWorldInverse.copy(rt.matrixWorld).invert()}this.updateCamera=function(rt){if(s===null)return;let pt=rt.near,Dt=rt.far;M.texture!==null&&(M.depthNear>0&&(pt=M.depthNear),M.depthFar>0&&(Dt=M.depthFar)),g.near=P.near=y.near=pt,g.far=P.far=y.far=Dt,(m!==g.near||E!==g.far)&&(s.updateRenderState({depthNear:g.near,depthFar:g.far}),m=g.near,E=g.far);const St=rt.parent,Z=g.cameras;dt(g,St);for(let J=0;J<Z.length;J++)dt(Z[J],St);Z.length===2?Q(g,y,P):g.projectionMatrix.copy(y.projectionMatrix),ct(rt,g,St)};function ct(rt,pt,Dt){Dt===null?rt.matrix.copy(pt.matrixWorld):(rt.matrix.copy(Dt.matrixWorld),rt.matrix.invert(),rt.matrix.multiply(pt.matrixWorld)),rt.matrix.decompose(rt.position,rt.quaternion,rt.scale),rt.updateMatrixWorld(!0),rt.projectionMatrix.copy(pt.projectionMatrix),rt.projectionMatrixInverse.copy(pt.projectionMatrixInverse),rt.isPerspectiveCamera&&(rt.fov=Jc*2*Math.atan(1/rt.projectionMatrix.elements[5]),rt.zoom=1)}this.getCamera=function(){return g},this.getFoveation=function(){if(!(h===null&&_===null))return l},this.setFoveation=function(rt){l=rt,h!==null&&(h.fixedFoveation=rt),_!==null&&_.fixedFoveation!==void 0&&(_.fixedFoveation=rt)},this.hasDepthSensing=function(){return M.texture!==null},this.getDepthSensingMesh=function(){return M.getMesh(g)};let gt=null;function xt(rt,pt){if(u=pt.getViewerPose(c||o),x=pt,u!==null){const Dt=u.views;_!==null&&(t.setRenderTargetFramebuffer(C,_.framebuffer),t.setRenderTarget(C));let St=!1;Dt.length!==g.cameras.length&&(g.cameras.length=0,St=!0);for(let J=0;J<Dt.length;J++){const Y=Dt[J];let ot=null;if(_!==null)ot=_.getViewport(Y);else{const I=f.getViewSubImage(h,Y);ot=I.viewport,J===0&&(t.setRenderTargetTextures(C,I.colorTexture,h.ignoreDepthValues?void 0:I.depthStencilTexture),t.setRenderTarget(C))}let at=O[J];at===void 0&&(at=new $n,at.layers.enable(J),at.viewport=new Ye,O[J]=at),at.matrix.fromArray(Y.transform.matrix),at.matrix.decompose(at.position,at.quaternion,at.scale),at.projectionMatrix.fromArray(Y.projectionMatrix),at.projectionMatrixInverse.copy(at.projectionMatrix).invert(),at.viewport.set(ot.x,ot.y,ot.width,ot.height),J===0&&(g.matrix.copy(at.matrix),g.matrix.decompose(g.position,g.quaternion,g.scale)),St===!0&&g.cameras.push(at)}const Z=s.enabledFeatures;if(Z&&Z.includes("depth-sensing")){const J=f.getDepthInformation(Dt[0]);J&&J.isValid&&J.texture&&M.init(t,J,s.renderState)}}for(let Dt=0;Dt<b.length;Dt++){const St=R[Dt],Z=b[Dt];St!==null&&Z!==void 0&&Z.update(St,pt,c||o)}gt&&gt(rt,pt),pt.detectedPlanes&&n.dispatchEvent({type:"planesdetected",data:pt}),x=null}const Vt=new op;Vt.setAnimationLoop(xt),this.setAnimationLoop=function(rt){gt=rt},this.dispose=function(){}}}const Ss=new bi,by=new Ge;function Ty(i,t){function e(p,d){p.matrixAutoUpdate===!0&&p.updateMatrix(),d.value.copy(p.matrix)}function n(p,d){d.color.getRGB(p.fogColor.value,ip(i)),d.isFog?(p.fogNear.value=d.near,p.fogFar.value=d.far):d.isFogExp2&&(p.fogDensity.value=d.density)}function s(p,d,C,b,R){d.isMeshBasicMaterial||d.isMeshLambertMaterial?r(p,d):d.isMeshToonMaterial?(r(p,d),f(p,d)):d.isMeshPhongMaterial?(r(p,d),u(p,d)):d.isMeshStandardMaterial?(r(p,d),h(p,d),d.isMeshPhysicalMaterial&&_(p,d,R)):d.isMeshMatcapMaterial?(r(p,d),x(p,d)):d.isMeshDepthMaterial?r(p,d):d.isMeshDistanceMaterial?(r(p,d),M(p,d)):d.isMeshNormalMaterial?r(p,d):d.isLineBasicMaterial?(o(p,d),d.isLineDashedMaterial&&a(p,d)):d.isPointsMaterial?l(p,d,C,b):d.isSpriteMaterial?c(p,d):d.isShadowMaterial?(p.color.value.copy(d.color),p.opacity.value=d.opacity):d.isShaderMaterial&&(d.uniformsNeedUpdate=!1)}function r(p,d){p.opacity.value=d.opacity,d.color&&p.diffuse.value.copy(d.color),d.emissive&&p.emissive.value.copy(d.emissive).multiplyScalar(d.emissiveIntensity),d.map&&(p.map.value=d.map,e(d.map,p.mapTransform)),d.alphaMap&&(p.alphaMap.value=d.alphaMap,e(d.alphaMap,p.alphaMapTransform)),d.bumpMap&&(p.bumpMap.value=d.bumpMap,e(d.bumpMap,p.bumpMapTransform),p.bumpScale.value=d.bumpScale,d.side===Nn&&(p.bumpScale.value*=-1)),d.normalMap&&(p.normalMap.value=d.normalMap,e(d.normalMap,p.normalMapTransform),p.normalScale.value.copy(d.normalScale),d.side===Nn&&p.normalScale.value.negate()),d.displacementMap&&(p.displacementMap.value=d.displacementMap,e(d.displacementMap,p.displacementMapTransform),p.displacementScale.value=d.displacementScale,p.displacementBias.value=d.displacementBias),d.emissiveMap&&(p.emissiveMap.value=d.emissiveMap,e(d.emissiveMap,p.emissiveMapTransform)),d.specularMap&&(p.specularMap.value=d.specularMap,e(d.specularMap,p.specularMapTransform)),d.alphaTest>0&&(p.alphaTest.value=d.alphaTest);const C=t.get(d),b=C.envMap,R=C.envMapRotation;b&&(p.envMap.value=b,Ss.copy(R),Ss.x*=-1,Ss.y*=-1,Ss.z*=-1,b.isCubeTexture&&b.isRenderTargetTexture===!1&&(Ss.y*=-1,Ss.z*=-1),p.envMapRotation.value.setFromMatrix4(by.makeRotationFromEuler(Ss)),p.flipEnvMap.value=b.isCubeTexture&&b.isRenderTargetTexture===!1?-1:1,p.reflectivity.value=d.reflectivity,p.ior.value=d.ior,p.refractionRatio.value=d.refractionRatio),d.lightMap&&(p.lightMap.value=d.lightMap,p.lightMapIntensity.value=d.lightMapIntensity,e(d.lightMap,p.lightMapTransform)),d.aoMap&&(p.aoMap.value=d.aoMap,p.aoMapIntensity.value=d.aoMapIntensity,e(d.aoMap,p.aoMapTransform))}function o(p,d){p.diffuse.value.copy(d.color),p.opacity.value=d.opacity,d.map&&(p.map.value=d.map,e(d.map,p.mapTransform))}function a(p,d){p.dashSize.value=d.dashSize,p.totalSize.value=d.dashSize+d.gapSize,p.scale.value=d.scale}function l(p,d,C,b){p.diffuse.value.copy(d.color),p.opacity.value=d.opacity,p.size.value=d.size*C,p.scale.value=b*.5,d.map&&(p.map.value=d.map,e(d.map,p.uvTransform)),d.alphaMap&&(p.alphaMap.value=d.alphaMap,e(d.alphaMap,p.alphaMapTransform)),d.alphaTest>0&&(p.alphaTest.value=d.alphaTest)}function c(p,d){p.diffuse.value.copy(d.color),p.opacity.value=d.opacity,p.rotation.value=d.rotation,d.map&&(p.map.value=d.map,e(d.map,p.mapTransform)),d.alphaMap&&(p.alphaMap.value=d.alphaMap,e(d.alphaMap,p.alphaMapTransform)),d.alphaTest>0&&(p.alphaTest.value=d.alphaTest)}function u(p,d){p.specular.value.copy(d.specular),p.shininess.value=Math.max(d.shininess,1e-4)}function f(p,d){d.gradientMap&&(p.gradientMap.value=d.gradientMap)}function h(p,d){p.metalness.value=d.metalness,d.metalnessMap&&(p.metalnessMap.value=d.metalnessMap,e(d.metalnessMap,p.metalnessMapTransform)),p.roughness.value=d.roughness,d.roughnessMap&&(p.roughnessMap.value=d.roughnessMap,e(d.roughnessMap,p.roughnessMapTransform)),d.envMap&&(p.envMapIntensity.value=d.envMapIntensity)}function _(p,d,C){p.ior.value=d.ior,d.sheen>0&&(p.sheenColor.value.copy(d.sheenColor).multiplyScalar(d.sheen),p.sheenRoughness.value=d.sheenRoughness,d.sheenColorMap&&(p.sheenColorMap.value=d.sheenColorMap,e(d.sheenColorMap,p.sheenColorMapTransform)),d.sheenRoughnessMap&&(p.sheenRoughnessMap.value=d.sheenRoughnessMap,e(d.sheenRoughnessMap,p.sheenRoughnessMapTransform))),d.clearcoat>0&&(p.clearcoat.value=d.clearcoat,p.clearcoatRoughness.value=d.clearcoatRoughness,d.clearcoatMap&&(p.clearcoatMap.value=d.clearcoatMap,e(d.clearcoatMap,p.clearcoatMapTransform)),d.clearcoatRoughnessMap&&(p.clearcoatRoughnessMap.value=d.clearcoatRoughnessMap,e(d.clearcoatRoughnessMap,p.clearcoatRoughnessMapTransform)),d.clearcoatNormalMap&&(p.clearcoatNormalMap.value=d.clearcoatNormalMap,e(d.clearcoatNormalMap,p.clearcoatNormalMapTransform),p.clearcoatNormalScale.value.copy(d.clearcoatNormalScale),d.side===Nn&&p.clearcoatNormalScale.value.negate())),d.dispersion>0&&(p.dispersion.value=d.dispersion),d.iridescence>0&&(p.iridescence.value=d.iridescence,p.iridescenceIOR.value=d.iridescenceIOR,p.iridescenceThicknessMinimum.value=d.iridescenceThicknessRange[0],p.iridescenceThicknessMaximum.value=d.iridescenceThicknessRange[1],d.iridescenceMap&&(p.iridescenceMap.value=d.iridescenceMap,e(d.iridescenceMap,p.iridescenceMapTransform)),d.iridescenceThicknessMap&&(p.iridescenceThicknessMap.value=d.iridescenceThicknessMap,e(d.iridescenceThicknessMap,p.iridescenceThicknessMapTransform))),d.transmission>0&&(p.transmission.value=d.transmission,p.transmissionSamplerMap.value=C.texture,p.transmissionSamplerSize.value.set(C.width,C.height),d.transmissionMap&&(p.transmissionMap.value=d.transmissionMap,e(d.transmissionMap,p.transmissionMapTransform)),p.thickness.value=d.thickness,d.thicknessMap&&(p.thicknessMap.value=d.thicknessMap,e(d.thicknessMap,p.thicknessMapTransform)),p.attenuationDistance.value=d.attenuationDistance,p.attenuationColor.value.copy(d.attenuationColor)),d.anisotropy>0&&(p.anisotropyVector.value.set(d.anisotropy*Math.cos(d.anisotropyRotation),d.anisotropy*Math.sin(d.anisotropyRotation)),d.anisotropyMap&&(p.anisotropyMap.value=d.anisotropyMap,e(d.anisotropyMap,p.anisotropyMapTransform))),p.specularIntensity.value=d.specularIntensity,p.specularColor.value.copy(d.specularColor),d.specularColorMap&&(p.specularColorMap.value=d.specularColorMap,e(d.specularColorMap,p.specularColorMapTransform)),d.specularIntensityMap&&(p.specularIntensityMap.value=d.specularIntensityMap,e(d.specularIntensityMap,p.specularIntensityMapTransform))}function x(p,d){d.matcap&&(p.matcap.value=d.matcap)}function M(p,d){const C=t.get(d).light;p.referencePosition.value.setFromMatrixPosition(C.matrixWorld),p.nearDistance.value=C.shadow.camera.near,p.farDistance.value=C.shadow.camera.far}return{refreshFogUniforms:n,refreshMaterialUniforms:s}}function Ay(i,t,e,n){let s={},r={},o=[];const a=i.getParameter(i.MAX_UNIFORM_BUFFER_BINDINGS);function l(C,b){const R=b.program;n.uniformBlockBinding(C,R)}function c(C,b){let R=s[C.id];R===void 0&&(x(C),R=u(C),s[C.id]=R,C.addEventListener("dispose",p));const D=b.program;n.updateUBOMapping(C,D);const A=t.render.frame;r[C.id]!==A&&(h(C),r[C.id]=A)}function u(C){const b=f();C.__bindingPointIndex=b;const R=i.createBuffer(),D=C.__size,A=C.usage;return i.bindBuffer(i.UNIFORM_BUFFER,R),i.bufferData(i.UNIFORM_BUFFER,D,A),i.bindBuffer(i.UNIFORM_BUFFER,null),i.bindBufferBase(i.UNIFORM_BUFFER,b,R),R}function f(){for(let C=0;C<a;C++)if(o.indexOf(C)===-1)return o.push(C),C;return console.error("THREE.WebGLRenderer: Maximum number of simultaneously usable uniforms groups reached."),0}function h(C){const b=s[C.id],R=C.uniforms,D=C.__cache;i.bindBuffer(i.UNIFORM_BUFFER,b);for(let A=0,y=R.length;A<y;A++){const P=Array.isArray(R[A])?R[A]:[R[A]];for(let O=0,g=P.length;O<g;O++){const m=P[O];if(_(m,A,O,D)===!0){const E=m.__offset,N=Array.isArray(m.value)?m.value:[m.value];let F=0;for(let B=0;B<N.length;B++){const G=N[B],K=M(G);typeof G=="number"||typeof G=="boolean"?(m.__data[0]=G,i.bufferSubData(i.UNIFORM_BUFFER,E+F,m.__data)):G.isMatrix3?(m.__data[0]=G.elements[0],m.__data[1]=G.elements[1],m.__data[2]=G.elements[2],m.__data[3]=0,m.__data[4]=G.elements[3],m.__data[5]=G.elements[4],m.__data[6]=G.elements[5],m.__data[7]=0,m.__data[8]=G.elements[6],m.__data[9]=G.elements[7],m.__data[10]=G.elements[8],m.__data[11]=0):(G.toArray(m.__data,F),F+=K.storage/Float32Array.BYTES_PER_ELEMENT)}i.bufferSubData(i.UNIFORM_BUFFER,E,m.__data)}}}i.bindBuffer(i.UNIFORM_BUFFER,null)}function _(C,b,R,D){const A=C.value,y=b+"_"+R;if(D[y]===void 0)return typeof A=="number"||typeof A=="boolean"?D[y]=A:D[y]=A.clone(),!0;{const P=D[y];if(typeof A=="number"||typeof A=="boolean"){if(P!==A)return D[y]=A,!0}else if(P.equals(A)===!1)return P.copy(A),!0}return!1}function x(C){const b=C.uniforms;let R=0;const D=16;for(let y=0,P=b.length;y<P;y++){const O=Array.isArray(b[y])?b[y]:[b[y]];for(let g=0,m=O.length;g<m;g++){const E=O[g],N=Array.isArray(E.value)?E.value:[E.value];for(let F=0,B=N.length;F<B;F++){const G=N[F],K=M(G),Q=R%D,dt=Q%K.boundary,ct=Q+dt;R+=dt,ct!==0&&D-ct<K.storage&&(R+=D-ct),E.__data=new Float32Array(K.storage/Float32Array.BYTES_PER_ELEMENT),E.__offset=R,R+=K.storage}}}const A=R%D;return A>0&&(R+=D-A),C.__size=R,C.__cache={},this}function M(C){const b={boundary:0,storage:0};return typeof C=="number"||typeof C=="boolean"?(b.boundary=4,b.storage=4):C.isVector2?(b.boundary=8,b.storage=8):C.isVector3||C.isColor?(b.boundary=16,b.storage=12):C.isVector4?(b.boundary=16,b.storage=16):C.isMatrix3?(b.boundary=48,b.storage=48):C.isMatrix4?(b.boundary=64,b.storage=64):C.isTexture?console.warn("THREE.WebGLRenderer: Texture samplers can not be part of an uniforms group."):console.warn("THREE.WebGLRenderer: Unsupported uniform value type.",C),b}function p(C){const b=C.target;b.removeEventListener("dispose",p);const R=o.indexOf(b.__bindingPointIndex);o.splice(R,1),i.deleteBuffer(s[b.id]),delete s[b.id],delete r[b.id]}function d(){for(const C in s)i.deleteBuffer(s[C]);o=[],s={},r={}}return{bind:l,update:c,dispose:d}}class Ry{constructor(t={}){const{canvas:e=m_(),context:n=null,depth:s=!0,stencil:r=!1,alpha:o=!1,antialias:a=!1,premultipliedAlpha:l=!0,preserveDrawingBuffer:c=!1,powerPreference:u="default",failIfMajorPerformanceCaveat:f=!1}=t;this.isWebGLRenderer=!0;let h;if(n!==null){if(typeof WebGLRenderingContext<"u"&&n instanceof WebGLRenderingContext)throw new Error("THREE.WebGLRenderer: WebGL 1 is not supported since r163.");h=n.getContextAttributes().alpha}else h=o;const _=new Uint32Array(4),x=new Int32Array(4);let M=null,p=null;const d=[],C=[];this.domElement=e,this.debug={checkShaderErrors:!0,onShaderError:null},this.autoClear=!0,this.autoClearColor=!0,this.autoClearDepth=!0,this.autoClearStencil=!0,this.sortObjects=!0,this.clippingPlanes=[],this.localClippingEnabled=!1,this._outputColorSpace=Mi,this.toneMapping=as,this.toneMappingExposure=1;const b=this;let R=!1,D=0,A=0,y=null,P=-1,O=null;const g=new Ye,m=new Ye;let E=null;const N=new ee(0);let F=0,B=e.width,G=e.height,K=1,Q=null,dt=null;const ct=new Ye(0,0,B,G),gt=new Ye(0,0,B,G);let xt=!1;const Vt=new bh;let rt=!1,pt=!1;const Dt=new Ge,St=new Ge,Z=new $,J=new Ye,Y={background:null,fog:null,environment:null,overrideMaterial:null,isScene:!0};let ot=!1;function at(){return y===null?K:1}let I=n;function Ot(T,W){return e.getContext(T,W)}try{const T={alpha:!0,depth:s,stencil:r,antialias:a,premultipliedAlpha:l,preserveDrawingBuffer:c,powerPreference:u,failIfMajorPerformanceCaveat:f};if("setAttribute"in e&&e.setAttribute("data-engine",`three.js r${mh}`),e.addEventListener("webglcontextlost",ft,!1),e.addEventListener("webglcontextrestored",Nt,!1),e.addEventListener("webglcontextcreationerror",Bt,!1),I===null){const W="webgl2";if(I=Ot(W,T),I===null)throw Ot(W)?new Error("Error creating WebGL context with your selected attributes."):new Error("Error creating WebGL context.")}}catch(T){throw console.error("THREE.WebGLRenderer: "+T.message),T}let Mt,Ht,At,Et,Xt,L,w,V,it,ht,nt,It,wt,Ut,re,mt,Rt,jt,$t,Lt,ne,Qt,pe,q;function Tt(){Mt=new Ix(I),Mt.init(),Qt=new vy(I,Mt),Ht=new Ax(I,Mt,t,Qt),At=new my(I),Ht.reverseDepthBuffer&&At.buffers.depth.setReversed(!0),Et=new kx(I),Xt=new ty,L=new _y(I,Mt,At,Xt,Ht,Qt,Et),w=new Cx(b),V=new Dx(b),it=new V_(I),pe=new bx(I,it),ht=new Ux(I,it,Et,pe),nt=new Fx(I,ht,it,Et),$t=new Ox(I,Ht,L),mt=new Rx(Xt),It=new QM(b,w,V,Mt,Ht,pe,mt),wt=new Ty(b,Xt),Ut=new ny,re=new ly(Mt),jt=new wx(b,w,V,At,nt,h,l),Rt=new dy(b,nt,Ht),q=new Ay(I,Et,Ht,At),Lt=new Tx(I,Mt,Et),ne=new Nx(I,Mt,Et),Et.programs=It.programs,b.capabilities=Ht,b.extensions=Mt,b.properties=Xt,b.renderLists=Ut,b.shadowMap=Rt,b.state=At,b.info=Et}Tt();const lt=new wy(b,I);this.xr=lt,this.getContext=function(){return I},this.getContextAttributes=function(){return I.getContextAttributes()},this.forceContextLoss=function(){const T=Mt.get("WEBGL_lose_context");T&&T.loseContext()},this.forceContextRestore=function(){const T=Mt.get("WEBGL_lose_context");T&&T.restoreContext()},this.getPixelRatio=function(){return K},this.setPixelRatio=function(T){T!==void 0&&(K=T,this.setSize(B,G,!1))},this.getSize=function(T){return T.set(B,G)},this.setSize=function(T,W,tt=!0){if(lt.isPresenting){console.warn("THREE.WebGLRenderer: Can't change size while VR device is presenting.");return}B=T,G=W,e.width=Math.floor(T*K),e.height=Math.floor(W*K),tt===!0&&(e.style.width=T+"px",e.style.height=W+"px"),this.setViewport(0,0,T,W)},this.getDrawingBufferSize=function(T){return T.set(B*K,G*K).floor()},this.setDrawingBufferSize=function(T,W,tt){B=T,G=W,K=tt,e.width=Math.floor(T*tt),e.height=Math.floor(W*tt),this.setViewport(0,0,T,W)},this.getCurrentViewport=function(T){return T.copy(g)},this.getViewport=function(T){return T.copy(ct)},this.setViewport=function(T,W,tt,et){T.isVector4?ct.set(T.x,T.y,T.z,T.w):ct.set(T,W,tt,et),At.viewport(g.copy(ct).multiplyScalar(K).round())},this.getScissor=function(T){return T.copy(gt)},this.setScissor=function(T,W,tt,et){T.isVector4?gt.set(T.x,T.y,T.z,T.w):gt.set(T,W,tt,et),At.scissor(m.copy(gt).multiplyScalar(K).round())},this.getScissorTest=function(){return xt},this.setScissorTest=function(T){At.setScissorTest(xt=T)},this.setOpaqueSort=function(T){Q=T},this.setTransparentSort=function(T){dt=T},this.getClearColor=function(T){return T.copy(jt.getClearColor())},this.setClearColor=function(){jt.setClearColor.apply(jt,arguments)},this.getClearAlpha=function(){return jt.getClearAlpha()},this.setClearAlpha=function(){jt.setClearAlpha.apply(jt,arguments)},this.clear=function(T=!0,W=!0,tt=!0){let et=0;if(T){let j=!1;if(y!==null){const vt=y.texture.format;j=vt===Sh||vt===yh||vt===Mh}if(j){const vt=y.texture.type,Ct=vt===Hi||vt===Ns||vt===Mo||vt===Pr||vt===vh||vt===xh,Gt=jt.getClearColor(),Wt=jt.getClearAlpha(),Jt=Gt.r,Zt=Gt.g,qt=Gt.b;Ct?(_[0]=Jt,_[1]=Zt,_[2]=qt,_[3]=Wt,I.clearBufferuiv(I.COLOR,0,_)):(x[0]=Jt,x[1]=Zt,x[2]=qt,x[3]=Wt,I.clearBufferiv(I.COLOR,0,x))}else et|=I.COLOR_BUFFER_BIT}W&&(et|=I.DEPTH_BUFFER_BIT,I.clearDepth(this.capabilities.reverseDepthBuffer?0:1)),tt&&(et|=I.STENCIL_BUFFER_BIT,this.state.buffers.stencil.setMask(4294967295)),I.clear(et)},this.clearColor=function(){this.clear(!0,!1,!1)},this.clearDepth=function(){this.clear(!1,!0,!1)},this.clearStencil=function(){this.clear(!1,!1,!0)},this.dispose=function(){e.removeEventListener("webglcontextlost",ft,!1),e.removeEventListener("webglcontextrestored",Nt,!1),e.removeEventListener("webglcontextcreationerror",Bt,!1),Ut.dispose(),re.dispose(),Xt.dispose(),w.dispose(),V.dispose(),nt.dispose(),pe.dispose(),q.dispose(),It.dispose(),lt.dispose(),lt.removeEventListener("sessionstart",ni),lt.removeEventListener("sessionend",Ti),Cn.stop()};function ft(T){T.preventDefault(),console.log("THREE.WebGLRenderer: Context Lost."),R=!0}function Nt(){console.log("THREE.WebGLRenderer: Context Restored."),R=!1;const T=Et.autoReset,W=Rt.enabled,tt=Rt.autoUpdate,et=Rt.needsUpdate,j=Rt.type;Tt(),Et.autoReset=T,Rt.enabled=W,Rt.autoUpdate=tt,Rt.needsUpdate=et,Rt.type=j}function Bt(T){console.error("THREE.WebGLRenderer: A WebGL context could not be created. Reason: ",T.statusMessage)}function fe(T){const W=T.target;W.removeEventListener("dispose",fe),Ve(W)}function Ve(T){mn(T),Xt.remove(T)}function mn(T){const W=Xt.get(T).programs;W!==void 0&&(W.forEach(function(tt){It.releaseProgram(tt)}),T.isShaderMaterial&&It.releaseShaderCache(T))}this.renderBufferDirect=function(T,W,tt,et,j,vt){W===null&&(W=Y);const Ct=j.isMesh&&j.matrixWorld.determinant()<0,Gt=il(T,W,tt,et,j);At.setMaterial(et,Ct);let Wt=tt.index,Jt=1;if(et.wireframe===!0){if(Wt=ht.getWireframeAttribute(tt),Wt===void 0)return;Jt=2}const Zt=tt.drawRange,qt=tt.attributes.position;let ge=Zt.start*Jt,Ee=(Zt.start+Zt.count)*Jt;vt!==null&&(ge=Math.max(ge,vt.start*Jt),Ee=Math.min(Ee,(vt.start+vt.count)*Jt)),Wt!==null?(ge=Math.max(ge,0),Ee=Math.min(Ee,Wt.count)):qt!=null&&(ge=Math.max(ge,0),Ee=Math.min(Ee,qt.count));const De=Ee-ge;if(De<0||De===1/0)return;pe.setup(j,et,Gt,tt,Wt);let dn,me=Lt;if(Wt!==null&&(dn=it.get(Wt),me=ne,me.setIndex(dn)),j.isMesh)et.wireframe===!0?(At.setLineWidth(et.wireframeLinewidth*at()),me.setMode(I.LINES)):me.setMode(I.TRIANGLES);else if(j.isLine){let Kt=et.linewidth;Kt===void 0&&(Kt=1),At.setLineWidth(Kt*at()),j.isLineSegments?me.setMode(I.LINES):j.isLineLoop?me.setMode(I.LINE_LOOP):me.setMode(I.LINE_STRIP)}else j.isPoints?me.setMode(I.POINTS):j.isSprite&&me.setMode(I.TRIANGLES);if(j.isBatchedMesh)if(j._multiDrawInstances!==null)me.renderMultiDrawInstances(j._multiDrawStarts,j._multiDrawCounts,j._multiDrawCount,j._multiDrawInstances);else if(Mt.get("WEBGL_multi_draw"))me.renderMultiDraw(j._multiDrawStarts,j._multiDrawCounts,j._multiDrawCount);else{const Kt=j._multiDrawStarts,Ae=j._multiDrawCounts,_e=j._multiDrawCount,Pn=Wt?it.get(Wt).bytesPerElement:1,pi=Xt.get(et).currentProgram.getUniforms();for(let _n=0;_n<_e;_n++)pi.setValue(I,"_gl_DrawID",_n),me.render(Kt[_n]/Pn,Ae[_n])}else if(j.isInstancedMesh)me.renderInstances(ge,De,j.count);else if(tt.isInstancedBufferGeometry){const Kt=tt._maxInstanceCount!==void 0?tt._maxInstanceCount:1/0,Ae=Math.min(tt.instanceCount,Kt);me.renderInstances(ge,De,Ae)}else me.render(ge,De)};function bt(T,W,tt){T.transparent===!0&&T.side===ki&&T.forceSinglePass===!1?(T.side=Nn,T.needsUpdate=!0,Hs(T,W,tt),T.side=cs,T.needsUpdate=!0,Hs(T,W,tt),T.side=ki):Hs(T,W,tt)}this.compile=function(T,W,tt=null){tt===null&&(tt=T),p=re.get(tt),p.init(W),C.push(p),tt.traverseVisible(function(j){j.isLight&&j.layers.test(W.layers)&&(p.pushLight(j),j.castShadow&&p.pushShadow(j))}),T!==tt&&T.traverseVisible(function(j){j.isLight&&j.layers.test(W.layers)&&(p.pushLight(j),j.castShadow&&p.pushShadow(j))}),p.setupLights();const et=new Set;return T.traverse(function(j){if(!(j.isMesh||j.isPoints||j.isLine||j.isSprite))return;const vt=j.material;if(vt)if(Array.isArray(vt))for(let Ct=0;Ct<vt.length;Ct++){const Gt=vt[Ct];bt(Gt,tt,j),et.add(Gt)}else bt(vt,tt,j),et.add(vt)}),C.pop(),p=null,et},this.compileAsync=function(T,W,tt=null){const et=this.compile(T,W,tt);return new Promise(j=>{function vt(){if(et.forEach(function(Ct){Xt.get(Ct).currentProgram.isReady()&&et.delete(Ct)}),et.size===0){j(T);return}setTimeout(vt,10)}Mt.get("KHR_parallel_shader_compile")!==null?vt():setTimeout(vt,10)})};let We=null;function Le(T){We&&We(T)}function ni(){Cn.stop()}function Ti(){Cn.start()}const Cn=new op;Cn.setAnimationLoop(Le),typeof self<"u"&&Cn.setContext(self),this.setAnimationLoop=function(T){We=T,lt.setAnimationLoop(T),T===null?Cn.stop():Cn.start()},lt.addEventListener("sessionstart",ni),lt.addEventListener("sessionend",Ti),this.render=function(T,W){if(W!==void 0&&W.isCamera!==!0){console.error("THREE.WebGLRenderer.render: camera is not an instance of THREE.Camera.");return}if(R===!0)return;if(T.matrixWorldAutoUpdate===!0&&T.updateMatrixWorld(),W.parent===null&&W.matrixWorldAutoUpdate===!0&&W.updateMatrixWorld(),lt.enabled===!0&&lt.isPresenting===!0&&(lt.cameraAutoUpdate===!0&&lt.updateCamera(W),W=lt.getCamera()),T.isScene===!0&&T.onBeforeRender(b,T,W,y),p=re.get(T,C.length),p.init(W),C.push(p),St.multiplyMatrices(W.projectionMatrix,W.matrixWorldInverse),Vt.setFromProjectionMatrix(St),pt=this.localClippingEnabled,rt=mt.init(this.clippingPlanes,pt),M=Ut.get(T,d.length),M.init(),d.push(M),lt.enabled===!0&&lt.isPresenting===!0){const vt=b.xr.getDepthSensingMesh();vt!==null&&gn(vt,W,-1/0,b.sortObjects)}gn(T,W,0,b.sortObjects),M.finish(),b.sortObjects===!0&&M.sort(Q,dt),ot=lt.enabled===!1||lt.isPresenting===!1||lt.hasDepthSensing()===!1,ot&&jt.addToRenderList(M,T),this.info.render.frame++,rt===!0&&mt.beginShadows();const tt=p.state.shadowsArray;Rt.render(tt,T,W),rt===!0&&mt.endShadows(),this.info.autoReset===!0&&this.info.reset();const et=M.opaque,j=M.transmissive;if(p.setupLights(),W.isArrayCamera){const vt=W.cameras;if(j.length>0)for(let Ct=0,Gt=vt.length;Ct<Gt;Ct++){const Wt=vt[Ct];Ri(et,j,T,Wt)}ot&&jt.render(T);for(let Ct=0,Gt=vt.length;Ct<Gt;Ct++){const Wt=vt[Ct];Ai(M,T,Wt,Wt.viewport)}}else j.length>0&&Ri(et,j,T,W),ot&&jt.render(T),Ai(M,T,W);y!==null&&(L.updateMultisampleRenderTarget(y),L.updateRenderTargetMipmap(y)),T.isScene===!0&&T.onAfterRender(b,T,W),pe.resetDefaultState(),P=-1,O=null,C.pop(),C.length>0?(p=C[C.length-1],rt===!0&&mt.setGlobalState(b.clippingPlanes,p.state.camera)):p=null,d.pop(),d.length>0?M=d[d.length-1]:M=null};function gn(T,W,tt,et){if(T.visible===!1)return;if(T.layers.test(W.layers)){if(T.isGroup)tt=T.renderOrder;else if(T.isLOD)T.autoUpdate===!0&&T.update(W);else if(T.isLight)p.pushLight(T),T.castShadow&&p.pushShadow(T);else if(T.isSprite){if(!T.frustumCulled||Vt.intersectsSprite(T)){et&&J.setFromMatrixPosition(T.matrixWorld).applyMatrix4(St);const Ct=nt.update(T),Gt=T.material;Gt.visible&&M.push(T,Ct,Gt,tt,J.z,null)}}else if((T.isMesh||T.isLine||T.isPoints)&&(!T.frustumCulled||Vt.intersectsObject(T))){const Ct=nt.update(T),Gt=T.material;if(et&&(T.boundingSphere!==void 0?(T.boundingSphere===null&&T.computeBoundingSphere(),J.copy(T.boundingSphere.center)):(Ct.boundingSphere===null&&Ct.computeBoundingSphere(),J.copy(Ct.boundingSphere.center)),J.applyMatrix4(T.matrixWorld).applyMatrix4(St)),Array.isArray(Gt)){const Wt=Ct.groups;for(let Jt=0,Zt=Wt.length;Jt<Zt;Jt++){const qt=Wt[Jt],ge=Gt[qt.materialIndex];ge&&ge.visible&&M.push(T,Ct,ge,tt,J.z,qt)}}else Gt.visible&&M.push(T,Ct,Gt,tt,J.z,null)}}const vt=T.children;for(let Ct=0,Gt=vt.length;Ct<Gt;Ct++)gn(vt[Ct],W,tt,et)}function Ai(T,W,tt,et){const j=T.opaque,vt=T.transmissive,Ct=T.transparent;p.setupLightsView(tt),rt===!0&&mt.setGlobalState(b.clippingPlanes,tt),et&&At.viewport(g.copy(et)),j.length>0&&ds(j,W,tt),vt.length>0&&ds(vt,W,tt),Ct.length>0&&ds(Ct,W,tt),At.buffers.depth.setTest(!0),At.buffers.depth.setMask(!0),At.buffers.color.setMask(!0),At.setPolygonOffset(!1)}function Ri(T,W,tt,et){if((tt.isScene===!0?tt.overrideMaterial:null)!==null)return;p.state.transmissionRenderTarget[et.id]===void 0&&(p.state.transmissionRenderTarget[et.id]=new ks(1,1,{generateMipmaps:!0,type:Mt.has("EXT_color_buffer_half_float")||Mt.has("EXT_color_buffer_float")?wo:Hi,minFilter:Ps,samples:4,stencilBuffer:r,resolveDepthBuffer:!1,resolveStencilBuffer:!1,colorSpace:ye.workingColorSpace}));const vt=p.state.transmissionRenderTarget[et.id],Ct=et.viewport||g;vt.setSize(Ct.z,Ct.w);const Gt=b.getRenderTarget();b.setRenderTarget(vt),b.getClearColor(N),F=b.getClearAlpha(),F<1&&b.setClearColor(16777215,.5),b.clear(),ot&&jt.render(tt);const Wt=b.toneMapping;b.toneMapping=as;const Jt=et.viewport;if(et.viewport!==void 0&&(et.viewport=void 0),p.setupLightsView(et),rt===!0&&mt.setGlobalState(b.clippingPlanes,et),ds(T,tt,et),L.updateMultisampleRenderTarget(vt),L.updateRenderTargetMipmap(vt),Mt.has("WEBGL_multisampled_render_to_texture")===!1){let Zt=!1;for(let qt=0,ge=W.length;qt<ge;qt++){const Ee=W[qt],De=Ee.object,dn=Ee.geometry,me=Ee.material,Kt=Ee.group;if(me.side===ki&&De.layers.test(et.layers)){const Ae=me.side;me.side=Nn,me.needsUpdate=!0,Xr(De,tt,et,dn,me,Kt),me.side=Ae,me.needsUpdate=!0,Zt=!0}}Zt===!0&&(L.updateMultisampleRenderTarget(vt),L.updateRenderTargetMipmap(vt))}b.setRenderTarget(Gt),b.setClearColor(N,F),Jt!==void 0&&(et.viewport=Jt),b.toneMapping=Wt}function ds(T,W,tt){const et=W.isScene===!0?W.overrideMaterial:null;for(let j=0,vt=T.length;j<vt;j++){const Ct=T[j],Gt=Ct.object,Wt=Ct.geometry,Jt=et===null?Ct.material:et,Zt=Ct.group;Gt.layers.test(tt.layers)&&Xr(Gt,W,tt,Wt,Jt,Zt)}}function Xr(T,W,tt,et,j,vt){T.onBeforeRender(b,W,tt,et,j,vt),T.modelViewMatrix.multiplyMatrices(tt.matrixWorldInverse,T.matrixWorld),T.normalMatrix.getNormalMatrix(T.modelViewMatrix),j.onBeforeRender(b,W,tt,et,T,vt),j.transparent===!0&&j.side===ki&&j.forceSinglePass===!1?(j.side=Nn,j.needsUpdate=!0,b.renderBufferDirect(tt,W,et,j,T,vt),j.side=cs,j.needsUpdate=!0,b.renderBufferDirect(tt,W,et,j,T,vt),j.side=ki):b.renderBufferDirect(tt,W,et,j,T,vt),T.onAfterRender(b,W,tt,et,j,vt)}function Hs(T,W,tt){W.isScene!==!0&&(W=Y);const et=Xt.get(T),j=p.state.lights,vt=p.state.shadowsArray,Ct=j.state.version,Gt=It.getParameters(T,j.state,vt,W,tt),Wt=It.getProgramCacheKey(Gt);let Jt=et.programs;et.environment=T.isMeshStandardMaterial?W.environment:null,et.fog=W.fog,et.envMap=(T.isMeshStandardMaterial?V:w).get(T.envMap||et.environment),et.envMapRotation=et.environment!==null&&T.envMap===null?W.environmentRotation:T.envMapRotation,Jt===void 0&&(T.addEventListener("dispose",fe),Jt=new Map,et.programs=Jt);let Zt=Jt.get(Wt);if(Zt!==void 0){if(et.currentProgram===Zt&&et.lightsStateVersion===Ct)return di(T,Gt),Zt}else Gt.uniforms=It.getUniforms(T),T.onBeforeCompile(Gt,b),Zt=It.acquireProgram(Gt,Wt),Jt.set(Wt,Zt),et.uniforms=Gt.uniforms;const qt=et.uniforms;return(!T.isShaderMaterial&&!T.isRawShaderMaterial||T.clipping===!0)&&(qt.clippingPlanes=mt.uniform),di(T,Gt),et.needsLights=Co(T),et.lightsStateVersion=Ct,et.needsLights&&(qt.ambientLightColor.value=j.state.ambient,qt.lightProbe.value=j.state.probe,qt.directionalLights.value=j.state.directional,qt.directionalLightShadows.value=j.state.directionalShadow,qt.spotLights.value=j.state.spot,qt.spotLightShadows.value=j.state.spotShadow,qt.rectAreaLights.value=j.state.rectArea,qt.ltc_1.value=j.state.rectAreaLTC1,qt.ltc_2.value=j.state.rectAreaLTC2,qt.pointLights.value=j.state.point,qt.pointLightShadows.value=j.state.pointShadow,qt.hemisphereLights.value=j.state.hemi,qt.directionalShadowMap.value=j.state.directionalShadowMap,qt.directionalShadowMatrix.value=j.state.directionalShadowMatrix,qt.spotShadowMap.value=j.state.spotShadowMap,qt.spotLightMatrix.value=j.state.spotLightMatrix,qt.spotLightMap.value=j.state.spotLightMap,qt.pointShadowMap.value=j.state.pointShadowMap,qt.pointShadowMatrix.value=j.state.pointShadowMatrix),et.currentProgram=Zt,et.uniformsList=null,Zt}function Ro(T){if(T.uniformsList===null){const W=T.currentProgram.getUniforms();T.uniformsList=ba.seqWithValue(W.seq,T.uniforms)}return T.uniformsList}function di(T,W){const tt=Xt.get(T);tt.outputColorSpace=W.outputColorSpace,tt.batching=W.batching,tt.batchingColor=W.batchingColor,tt.instancing=W.instancing,tt.instancingColor=W.instancingColor,tt.instancingMorph=W.instancingMorph,tt.skinning=W.skinning,tt.morphTargets=W.morphTargets,tt.morphNormals=W.morphNormals,tt.morphColors=W.morphColors,tt.morphTargetsCount=W.morphTargetsCount,tt.numClippingPlanes=W.numClippingPlanes,tt.numIntersection=W.numClipIntersection,tt.vertexAlphas=W.vertexAlphas,tt.vertexTangents=W.vertexTangents,tt.toneMapping=W.toneMapping}function il(T,W,tt,et,j){W.isScene!==!0&&(W=Y),L.resetTextureUnits();const vt=W.fog,Ct=et.isMeshStandardMaterial?W.environment:null,Gt=y===null?b.outputColorSpace:y.isXRRenderTarget===!0?y.texture.colorSpace:fs,Wt=(et.isMeshStandardMaterial?V:w).get(et.envMap||Ct),Jt=et.vertexColors===!0&&!!tt.attributes.color&&tt.attributes.color.itemSize===4,Zt=!!tt.attributes.tangent&&(!!et.normalMap||et.anisotropy>0),qt=!!tt.morphAttributes.position,ge=!!tt.morphAttributes.normal,Ee=!!tt.morphAttributes.color;let De=as;et.toneMapped&&(y===null||y.isXRRenderTarget===!0)&&(De=b.toneMapping);const dn=tt.morphAttributes.position||tt.morphAttributes.normal||tt.morphAttributes.color,me=dn!==void 0?dn.length:0,Kt=Xt.get(et),Ae=p.state.lights;if(rt===!0&&(pt===!0||T!==O)){const En=T===O&&et.id===P;mt.setState(et,T,En)}let _e=!1;et.version===Kt.__version?(Kt.needsLights&&Kt.lightsStateVersion!==Ae.state.version||Kt.outputColorSpace!==Gt||j.isBatchedMesh&&Kt.batching===!1||!j.isBatchedMesh&&Kt.batching===!0||j.isBatchedMesh&&Kt.batchingColor===!0&&j.colorTexture===null||j.isBatchedMesh&&Kt.batchingColor===!1&&j.colorTexture!==null||j.isInstancedMesh&&Kt.instancing===!1||!j.isInstancedMesh&&Kt.instancing===!0||j.isSkinnedMesh&&Kt.skinning===!1||!j.isSkinnedMesh&&Kt.skinning===!0||j.isInstancedMesh&&Kt.instancingColor===!0&&j.instanceColor===null||j.isInstancedMesh&&Kt.instancingColor===!1&&j.instanceColor!==null||j.isInstancedMesh&&Kt.instancingMorph===!0&&j.morphTexture===null||j.isInstancedMesh&&Kt.instancingMorph===!1&&j.morphTexture!==null||Kt.envMap!==Wt||et.fog===!0&&Kt.fog!==vt||Kt.numClippingPlanes!==void 0&&(Kt.numClippingPlanes!==mt.numPlanes||Kt.numIntersection!==mt.numIntersection)||Kt.vertexAlphas!==Jt||Kt.vertexTangents!==Zt||Kt.morphTargets!==qt||Kt.morphNormals!==ge||Kt.morphColors!==Ee||Kt.toneMapping!==De||Kt.morphTargetsCount!==me)&&(_e=!0):(_e=!0,Kt.__version=et.version);let Pn=Kt.currentProgram;_e===!0&&(Pn=Hs(et,W,j));let pi=!1,_n=!1,qr=!1;const He=Pn.getUniforms(),mi=Kt.uniforms;if(At.useProgram(Pn.program)&&(pi=!0,_n=!0,qr=!0),et.id!==P&&(P=et.id,_n=!0),pi||O!==T){Ht.reverseDepthBuffer?(Dt.copy(T.projectionMatrix),__(Dt),v_(Dt),He.setValue(I,"projectionMatrix",Dt)):He.setValue(I,"projectionMatrix",T.projectionMatrix),He.setValue(I,"viewMatrix",T.matrixWorldInverse);const En=He.map.cameraPosition;En!==void 0&&En.setValue(I,Z.setFromMatrixPosition(T.matrixWorld)),Ht.logarithmicDepthBuffer&&He.setValue(I,"logDepthBufFC",2/(Math.log(T.far+1)/Math.LN2)),(et.isMeshPhongMaterial||et.isMeshToonMaterial||et.isMeshLambertMaterial||et.isMeshBasicMaterial||et.isMeshStandardMaterial||et.isShaderMaterial)&&He.setValue(I,"isOrthographic",T.isOrthographicCamera===!0),O!==T&&(O=T,_n=!0,qr=!0)}if(j.isSkinnedMesh){He.setOptional(I,j,"bindMatrix"),He.setOptional(I,j,"bindMatrixInverse");const En=j.skeleton;En&&(En.boneTexture===null&&En.computeBoneTexture(),He.setValue(I,"boneTexture",En.boneTexture,L))}j.isBatchedMesh&&(He.setOptional(I,j,"batchingTexture"),He.setValue(I,"batchingTexture",j._matricesTexture,L),He.setOptional(I,j,"batchingIdTexture"),He.setValue(I,"batchingIdTexture",j._indirectTexture,L),He.setOptional(I,j,"batchingColorTexture"),j._colorsTexture!==null&&He.setValue(I,"batchingColorTexture",j._colorsTexture,L));const Gs=tt.morphAttributes;if((Gs.position!==void 0||Gs.normal!==void 0||Gs.color!==void 0)&&$t.update(j,tt,Pn),(_n||Kt.receiveShadow!==j.receiveShadow)&&(Kt.receiveShadow=j.receiveShadow,He.setValue(I,"receiveShadow",j.receiveShadow)),et.isMeshGouraudMaterial&&et.envMap!==null&&(mi.envMap.value=Wt,mi.flipEnvMap.value=Wt.isCubeTexture&&Wt.isRenderTargetTexture===!1?-1:1),et.isMeshStandardMaterial&&et.envMap===null&&W.environment!==null&&(mi.envMapIntensity.value=W.environmentIntensity),_n&&(He.setValue(I,"toneMappingExposure",b.toneMappingExposure),Kt.needsLights&&ps(mi,qr),vt&&et.fog===!0&&wt.refreshFogUniforms(mi,vt),wt.refreshMaterialUniforms(mi,et,K,G,p.state.transmissionRenderTarget[T.id]),ba.upload(I,Ro(Kt),mi,L)),et.isShaderMaterial&&et.uniformsNeedUpdate===!0&&(ba.upload(I,Ro(Kt),mi,L),et.uniformsNeedUpdate=!1),et.isSpriteMaterial&&He.setValue(I,"center",j.center),He.setValue(I,"modelViewMatrix",j.modelViewMatrix),He.setValue(I,"normalMatrix",j.normalMatrix),He.setValue(I,"modelMatrix",j.matrixWorld),et.isShaderMaterial||et.isRawShaderMaterial){const En=et.uniformsGroups;for(let Yr=0,Po=En.length;Yr<Po;Yr++){const Vs=En[Yr];q.update(Vs,Pn),q.bind(Vs,Pn)}}return Pn}function ps(T,W){T.ambientLightColor.needsUpdate=W,T.lightProbe.needsUpdate=W,T.directionalLights.needsUpdate=W,T.directionalLightShadows.needsUpdate=W,T.pointLights.needsUpdate=W,T.pointLightShadows.needsUpdate=W,T.spotLights.needsUpdate=W,T.spotLightShadows.needsUpdate=W,T.rectAreaLights.needsUpdate=W,T.hemisphereLights.needsUpdate=W}function Co(T){return T.isMeshLambertMaterial||T.isMeshToonMaterial||T.isMeshPhongMaterial||T.isMeshStandardMaterial||T.isShadowMaterial||T.isShaderMaterial&&T.lights===!0}this.getActiveCubeFace=function(){return D},this.getActiveMipmapLevel=function(){return A},this.getRenderTarget=function(){return y},this.setRenderTargetTextures=function(T,W,tt){Xt.get(T.texture).__webglTexture=W,Xt.get(T.depthTexture).__webglTexture=tt;const et=Xt.get(T);et.__hasExternalTextures=!0,et.__autoAllocateDepthBuffer=tt===void 0,et.__autoAllocateDepthBuffer||Mt.has("WEBGL_multisampled_render_to_texture")===!0&&(console.warn("THREE.WebGLRenderer: Render-to-texture extension was disabled because an external texture was provided"),et.__useRenderToTexture=!1)},this.setRenderTargetFramebuffer=function(T,W){const tt=Xt.get(T);tt.__webglFramebuffer=W,tt.__useDefaultFramebuffer=W===void 0},this.setRenderTarget=function(T,W=0,tt=0){y=T,D=W,A=tt;let et=!0,j=null,vt=!1,Ct=!1;if(T){const Wt=Xt.get(T);if(Wt.__useDefaultFramebuffer!==void 0)At.bindFramebuffer(I.FRAMEBUFFER,null),et=!1;else if(Wt.__webglFramebuffer===void 0)L.setupRenderTarget(T);else if(Wt.__hasExternalTextures)L.rebindTextures(T,Xt.get(T.texture).__webglTexture,Xt.get(T.depthTexture).__webglTexture);else if(T.depthBuffer){const qt=T.depthTexture;if(Wt.__boundDepthTexture!==qt){if(qt!==null&&Xt.has(qt)&&(T.width!==qt.image.width||T.height!==qt.image.height))throw new Error("WebGLRenderTarget: Attached DepthTexture is initialized to the incorrect size.");L.setupDepthRenderbuffer(T)}}const Jt=T.texture;(Jt.isData3DTexture||Jt.isDataArrayTexture||Jt.isCompressedArrayTexture)&&(Ct=!0);const Zt=Xt.get(T).__webglFramebuffer;T.isWebGLCubeRenderTarget?(Array.isArray(Zt[W])?j=Zt[W][tt]:j=Zt[W],vt=!0):T.samples>0&&L.useMultisampledRTT(T)===!1?j=Xt.get(T).__webglMultisampledFramebuffer:Array.isArray(Zt)?j=Zt[tt]:j=Zt,g.copy(T.viewport),m.copy(T.scissor),E=T.scissorTest}else g.copy(ct).multiplyScalar(K).floor(),m.copy(gt).multiplyScalar(K).floor(),E=xt;if(At.bindFramebuffer(I.FRAMEBUFFER,j)&&et&&At.drawBuffers(T,j),At.viewport(g),At.scissor(m),At.setScissorTest(E),vt){const Wt=Xt.get(T.texture);I.framebufferTexture2D(I.FRAMEBUFFER,I.COLOR_ATTACHMENT0,I.TEXTURE_CUBE_MAP_POSITIVE_X+W,Wt.__webglTexture,tt)}else if(Ct){const Wt=Xt.get(T.texture),Jt=W||0;I.framebufferTextureLayer(I.FRAMEBUFFER,I.COLOR_ATTACHMENT0,Wt.__webglTexture,tt||0,Jt)}P=-1},this.readRenderTargetPixels=function(T,W,tt,et,j,vt,Ct){if(!(T&&T.isWebGLRenderTarget)){console.error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");return}let Gt=Xt.get(T).__webglFramebuffer;if(T.isWebGLCubeRenderTarget&&Ct!==void 0&&(Gt=Gt[Ct]),Gt){At.bindFramebuffer(I.FRAMEBUFFER,Gt);try{const Wt=T.texture,Jt=Wt.format,Zt=Wt.type;if(!Ht.textureFormatReadable(Jt)){console.error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not in RGBA or implementation defined format.");return}if(!Ht.textureTypeReadable(Zt)){console.error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not in UnsignedByteType or implementation defined type.");return}W>=0&&W<=T.width-et&&tt>=0&&tt<=T.height-j&&I.readPixels(W,tt,et,j,Qt.convert(Jt),Qt.convert(Zt),vt)}finally{const Wt=y!==null?Xt.get(y).__webglFramebuffer:null;At.bindFramebuffer(I.FRAMEBUFFER,Wt)}}},this.readRenderTargetPixelsAsync=async function(T,W,tt,et,j,vt,Ct){if(!(T&&T.isWebGLRenderTarget))throw new Error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");let Gt=Xt.get(T).__webglFramebuffer;if(T.isWebGLCubeRenderTarget&&Ct!==void 0&&(Gt=Gt[Ct]),Gt){const Wt=T.texture,Jt=Wt.format,Zt=Wt.type;if(!Ht.textureFormatReadable(Jt))throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in RGBA or implementation defined format.");if(!Ht.textureTypeReadable(Zt))throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in UnsignedByteType or implementation defined type.");if(W>=0&&W<=T.width-et&&tt>=0&&tt<=T.height-j){At.bindFramebuffer(I.FRAMEBUFFER,Gt);const qt=I.createBuffer();I.bindBuffer(I.PIXEL_PACK_BUFFER,qt),I.bufferData(I.PIXEL_PACK_BUFFER,vt.byteLength,I.STREAM_READ),I.readPixels(W,tt,et,j,Qt.convert(Jt),Qt.convert(Zt),0);const ge=y!==null?Xt.get(y).__webglFramebuffer:null;At.bindFramebuffer(I.FRAMEBUFFER,ge);const Ee=I.fenceSync(I.SYNC_GPU_COMMANDS_COMPLETE,0);return I.flush(),await g_(I,Ee,4),I.bindBuffer(I.PIXEL_PACK_BUFFER,qt),I.getBufferSubData(I.PIXEL_PACK_BUFFER,0,vt),I.deleteBuffer(qt),I.deleteSync(Ee),vt}else throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: requested read bounds are out of range.")}},this.copyFramebufferToTexture=function(T,W=null,tt=0){T.isTexture!==!0&&(wa("WebGLRenderer: copyFramebufferToTexture function signature has changed."),W=arguments[0]||null,T=arguments[1]);const et=Math.pow(2,-tt),j=Math.floor(T.image.width*et),vt=Math.floor(T.image.height*et),Ct=W!==null?W.x:0,Gt=W!==null?W.y:0;L.setTexture2D(T,0),I.copyTexSubImage2D(I.TEXTURE_2D,tt,0,0,Ct,Gt,j,vt),At.unbindTexture()},this.copyTextureToTexture=function(T,W,tt=null,et=null,j=0){T.isTexture!==!0&&(wa("WebGLRenderer: copyTextureToTexture function signature has changed."),et=arguments[0]||null,T=arguments[1],W=arguments[2],j=arguments[3]||0,tt=null);let vt,Ct,Gt,Wt,Jt,Zt;tt!==null?(vt=tt.max.x-tt.min.x,Ct=tt.max.y-tt.min.y,Gt=tt.min.x,Wt=tt.min.y):(vt=T.image.width,Ct=T.image.height,Gt=0,Wt=0),et!==null?(Jt=et.x,Zt=et.y):(Jt=0,Zt=0);const qt=Qt.convert(W.format),ge=Qt.convert(W.type);L.setTexture2D(W,0),I.pixelStorei(I.UNPACK_FLIP_Y_WEBGL,W.flipY),I.pixelStorei(I.UNPACK_PREMULTIPLY_ALPHA_WEBGL,W.premultiplyAlpha),I.pixelStorei(I.UNPACK_ALIGNMENT,W.unpackAlignment);const Ee=I.getParameter(I.UNPACK_ROW_LENGTH),De=I.getParameter(I.UNPACK_IMAGE_HEIGHT),dn=I.getParameter(I.UNPACK_SKIP_PIXELS),me=I.getParameter(I.UNPACK_SKIP_ROWS),Kt=I.getParameter(I.UNPACK_SKIP_IMAGES),Ae=T.isCompressedTexture?T.mipmaps[j]:T.image;I.pixelStorei(I.UNPACK_ROW_LENGTH,Ae.width),I.pixelStorei(I.UNPACK_IMAGE_HEIGHT,Ae.height),I.pixelStorei(I.UNPACK_SKIP_PIXELS,Gt),I.pixelStorei(I.UNPACK_SKIP_ROWS,Wt),T.isDataTexture?I.texSubImage2D(I.TEXTURE_2D,j,Jt,Zt,vt,Ct,qt,ge,Ae.data):T.isCompressedTexture?I.compressedTexSubImage2D(I.TEXTURE_2D,j,Jt,Zt,Ae.width,Ae.height,qt,Ae.data):I.texSubImage2D(I.TEXTURE_2D,j,Jt,Zt,vt,Ct,qt,ge,Ae),I.pixelStorei(I.UNPACK_ROW_LENGTH,Ee),I.pixelStorei(I.UNPACK_IMAGE_HEIGHT,De),I.pixelStorei(I.UNPACK_SKIP_PIXELS,dn),I.pixelStorei(I.UNPACK_SKIP_ROWS,me),I.pixelStorei(I.UNPACK_SKIP_IMAGES,Kt),j===0&&W.generateMipmaps&&I.generateMipmap(I.TEXTURE_2D),At.unbindTexture()},this.copyTextureToTexture3D=function(T,W,tt=null,et=null,j=0){T.isTexture!==!0&&(wa("WebGLRenderer: copyTextureToTexture3D function signature has changed."),tt=arguments[0]||null,et=arguments[1]||null,T=arguments[2],W=arguments[3],j=arguments[4]||0);let vt,Ct,Gt,Wt,Jt,Zt,qt,ge,Ee;const De=T.isCompressedTexture?T.mipmaps[j]:T.image;tt!==null?(vt=tt.max.x-tt.min.x,Ct=tt.max.y-tt.min.y,Gt=tt.max.z-tt.min.z,Wt=tt.min.x,Jt=tt.min.y,Zt=tt.min.z):(vt=De.width,Ct=De.height,Gt=De.depth,Wt=0,Jt=0,Zt=0),et!==null?(qt=et.x,ge=et.y,Ee=et.z):(qt=0,ge=0,Ee=0);const dn=Qt.convert(W.format),me=Qt.convert(W.type);let Kt;if(W.isData3DTexture)L.setTexture3D(W,0),Kt=I.TEXTURE_3D;else if(W.isDataArrayTexture||W.isCompressedArrayTexture)L.setTexture2DArray(W,0),Kt=I.TEXTURE_2D_ARRAY;else{console.warn("THREE.WebGLRenderer.copyTextureToTexture3D: only supports THREE.DataTexture3D and THREE.DataTexture2DArray.");return}I.pixelStorei(I.UNPACK_FLIP_Y_WEBGL,W.flipY),I.pixelStorei(I.UNPACK_PREMULTIPLY_ALPHA_WEBGL,W.premultiplyAlpha),I.pixelStorei(I.UNPACK_ALIGNMENT,W.unpackAlignment);const Ae=I.getParameter(I.UNPACK_ROW_LENGTH),_e=I.getParameter(I.UNPACK_IMAGE_HEIGHT),Pn=I.getParameter(I.UNPACK_SKIP_PIXELS),pi=I.getParameter(I.UNPACK_SKIP_ROWS),_n=I.getParameter(I.UNPACK_SKIP_IMAGES);I.pixelStorei(I.UNPACK_ROW_LENGTH,De.width),I.pixelStorei(I.UNPACK_IMAGE_HEIGHT,De.height),I.pixelStorei(I.UNPACK_SKIP_PIXELS,Wt),I.pixelStorei(I.UNPACK_SKIP_ROWS,Jt),I.pixelStorei(I.UNPACK_SKIP_IMAGES,Zt),T.isDataTexture||T.isData3DTexture?I.texSubImage3D(Kt,j,qt,ge,Ee,vt,Ct,Gt,dn,me,De.data):W.isCompressedArrayTexture?I.compressedTexSubImage3D(Kt,j,qt,ge,Ee,vt,Ct,Gt,dn,De.data):I.texSubImage3D(Kt,j,qt,ge,Ee,vt,Ct,Gt,dn,me,De),I.pixelStorei(I.UNPACK_ROW_LENGTH,Ae),I.pixelStorei(I.UNPACK_IMAGE_HEIGHT,_e),I.pixelStorei(I.UNPACK_SKIP_PIXELS,Pn),I.pixelStorei(I.UNPACK_SKIP_ROWS,pi),I.pixelStorei(I.UNPACK_SKIP_IMAGES,_n),j===0&&W.generateMipmaps&&I.generateMipmap(Kt),At.unbindTexture()},this.initRenderTarget=function(T){Xt.get(T).__webglFramebuffer===void 0&&L.setupRenderTarget(T)},this.initTexture=function(T){T.isCubeTexture?L.setTextureCube(T,0):T.isData3DTexture?L.setTexture3D(T,0):T.isDataArrayTexture||T.isCompressedArrayTexture?L.setTexture2DArray(T,0):L.setTexture2D(T,0),At.unbindTexture()},this.resetState=function(){D=0,A=0,y=null,At.reset(),pe.reset()},typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}get coordinateSystem(){return Fi}get outputColorSpace(){return this._outputColorSpace}set outputColorSpace(t){this._outputColorSpace=t;const e=this.getContext();e.drawingBufferColorSpace=t===Eh?"display-p3":"srgb",e.unpackColorSpace=ye.workingColorSpace===Ga?"display-p3":"srgb"}}class Cy extends fn{constructor(){super(),this.isScene=!0,this.type="Scene",this.background=null,this.environment=null,this.fog=null,this.backgroundBlurriness=0,this.backgroundIntensity=1,this.backgroundRotation=new bi,this.environmentIntensity=1,this.environmentRotation=new bi,this.overrideMaterial=null,typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}copy(t,e){return super.copy(t,e),t.background!==null&&(this.background=t.background.clone()),t.environment!==null&&(this.environment=t.environment.clone()),t.fog!==null&&(this.fog=t.fog.clone()),this.backgroundBlurriness=t.backgroundBlurriness,this.backgroundIntensity=t.backgroundIntensity,this.backgroundRotation.copy(t.backgroundRotation),this.environmentIntensity=t.environmentIntensity,this.environmentRotation.copy(t.environmentRotation),t.overrideMaterial!==null&&(this.overrideMaterial=t.overrideMaterial.clone()),this.matrixAutoUpdate=t.matrixAutoUpdate,this}toJSON(t){const e=super.toJSON(t);return this.fog!==null&&(e.object.fog=this.fog.toJSON()),this.backgroundBlurriness>0&&(e.object.backgroundBlurriness=this.backgroundBlurriness),this.backgroundIntensity!==1&&(e.object.backgroundIntensity=this.backgroundIntensity),e.object.backgroundRotation=this.backgroundRotation.toArray(),this.environmentIntensity!==1&&(e.object.environmentIntensity=this.environmentIntensity),e.object.environmentRotation=this.environmentRotation.toArray(),e}}class Ao extends Fr{constructor(t){super(),this.isLineBasicMaterial=!0,this.type="LineBasicMaterial",this.color=new ee(16777215),this.map=null,this.linewidth=1,this.linecap="round",this.linejoin="round",this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.linewidth=t.linewidth,this.linecap=t.linecap,this.linejoin=t.linejoin,this.fog=t.fog,this}}const Na=new $,ka=new $,xf=new Ge,oo=new wh,ra=new Va,Yl=new $,Mf=new $;class Ah extends fn{constructor(t=new Sn,e=new Ao){super(),this.isLine=!0,this.type="Line",this.geometry=t,this.material=e,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}computeLineDistances(){const t=this.geometry;if(t.index===null){const e=t.attributes.position,n=[0];for(let s=1,r=e.count;s<r;s++)Na.fromBufferAttribute(e,s-1),ka.fromBufferAttribute(e,s),n[s]=n[s-1],n[s]+=Na.distanceTo(ka);t.setAttribute("lineDistance",new Be(n,1))}else console.warn("THREE.Line.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}raycast(t,e){const n=this.geometry,s=this.matrixWorld,r=t.params.Line.threshold,o=n.drawRange;if(n.boundingSphere===null&&n.computeBoundingSphere(),ra.copy(n.boundingSphere),ra.applyMatrix4(s),ra.radius+=r,t.ray.intersectsSphere(ra)===!1)return;xf.copy(s).invert(),oo.copy(t.ray).applyMatrix4(xf);const a=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=a*a,c=this.isLineSegments?2:1,u=n.index,h=n.attributes.position;if(u!==null){const _=Math.max(0,o.start),x=Math.min(u.count,o.start+o.count);for(let M=_,p=x-1;M<p;M+=c){const d=u.getX(M),C=u.getX(M+1),b=oa(this,t,oo,l,d,C);b&&e.push(b)}if(this.isLineLoop){const M=u.getX(x-1),p=u.getX(_),d=oa(this,t,oo,l,M,p);d&&e.push(d)}}else{const _=Math.max(0,o.start),x=Math.min(h.count,o.start+o.count);for(let M=_,p=x-1;M<p;M+=c){const d=oa(this,t,oo,l,M,M+1);d&&e.push(d)}if(this.isLineLoop){const M=oa(this,t,oo,l,x-1,_);M&&e.push(M)}}}updateMorphTargets(){const e=this.geometry.morphAttributes,n=Object.keys(e);if(n.length>0){const s=e[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){const a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}}function oa(i,t,e,n,s,r){const o=i.geometry.attributes.position;if(Na.fromBufferAttribute(o,s),ka.fromBufferAttribute(o,r),e.distanceSqToSegment(Na,ka,Yl,Mf)>n)return;Yl.applyMatrix4(i.matrixWorld);const l=t.ray.origin.distanceTo(Yl);if(!(l<t.near||l>t.far))return{distance:l,point:Mf.clone().applyMatrix4(i.matrixWorld),index:s,face:null,faceIndex:null,barycoord:null,object:i}}const yf=new $,Sf=new $;class Rh extends Ah{constructor(t,e){super(t,e),this.isLineSegments=!0,this.type="LineSegments"}computeLineDistances(){const t=this.geometry;if(t.index===null){const e=t.attributes.position,n=[];for(let s=0,r=e.count;s<r;s+=2)yf.fromBufferAttribute(e,s),Sf.fromBufferAttribute(e,s+1),n[s]=s===0?0:n[s-1],n[s+1]=n[s]+yf.distanceTo(Sf);t.setAttribute("lineDistance",new Be(n,1))}else console.warn("THREE.LineSegments.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}}class qa extends Sn{constructor(t=1,e=1,n=1,s=32,r=1,o=!1,a=0,l=Math.PI*2){super(),this.type="CylinderGeometry",this.parameters={radiusTop:t,radiusBottom:e,height:n,radialSegments:s,heightSegments:r,openEnded:o,thetaStart:a,thetaLength:l};const c=this;s=Math.floor(s),r=Math.floor(r);const u=[],f=[],h=[],_=[];let x=0;const M=[],p=n/2;let d=0;C(),o===!1&&(t>0&&b(!0),e>0&&b(!1)),this.setIndex(u),this.setAttribute("position",new Be(f,3)),this.setAttribute("normal",new Be(h,3)),this.setAttribute("uv",new Be(_,2));function C(){const R=new $,D=new $;let A=0;const y=(e-t)/n;for(let P=0;P<=r;P++){const O=[],g=P/r,m=g*(e-t)+t;for(let E=0;E<=s;E++){const N=E/s,F=N*l+a,B=Math.sin(F),G=Math.cos(F);D.x=m*B,D.y=-g*n+p,D.z=m*G,f.push(D.x,D.y,D.z),R.set(B,y,G).normalize(),h.push(R.x,R.y,R.z),_.push(N,1-g),O.push(x++)}M.push(O)}for(let P=0;P<s;P++)for(let O=0;O<r;O++){const g=M[O][P],m=M[O+1][P],E=M[O+1][P+1],N=M[O][P+1];t>0&&(u.push(g,m,N),A+=3),e>0&&(u.push(m,E,N),A+=3)}c.addGroup(d,A,0),d+=A}function b(R){const D=x,A=new se,y=new $;let P=0;const O=R===!0?t:e,g=R===!0?1:-1;for(let E=1;E<=s;E++)f.push(0,p*g,0),h.push(0,g,0),_.push(.5,.5),x++;const m=x;for(let E=0;E<=s;E++){const F=E/s*l+a,B=Math.cos(F),G=Math.sin(F);y.x=O*G,y.y=p*g,y.z=O*B,f.push(y.x,y.y,y.z),h.push(0,g,0),A.x=B*.5+.5,A.y=G*.5*g+.5,_.push(A.x,A.y),x++}for(let E=0;E<s;E++){const N=D+E,F=m+E;R===!0?u.push(F,F+1,N):u.push(F+1,F,N),P+=3}c.addGroup(d,P,R===!0?1:2),d+=P}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new qa(t.radiusTop,t.radiusBottom,t.height,t.radialSegments,t.heightSegments,t.openEnded,t.thetaStart,t.thetaLength)}}const aa=new $,la=new $,jl=new $,ca=new Zn;class Py extends Sn{constructor(t=null,e=1){if(super(),this.type="EdgesGeometry",this.parameters={geometry:t,thresholdAngle:e},t!==null){const s=Math.pow(10,4),r=Math.cos(mo*e),o=t.getIndex(),a=t.getAttribute("position"),l=o?o.count:a.count,c=[0,0,0],u=["a","b","c"],f=new Array(3),h={},_=[];for(let x=0;x<l;x+=3){o?(c[0]=o.getX(x),c[1]=o.getX(x+1),c[2]=o.getX(x+2)):(c[0]=x,c[1]=x+1,c[2]=x+2);const{a:M,b:p,c:d}=ca;if(M.fromBufferAttribute(a,c[0]),p.fromBufferAttribute(a,c[1]),d.fromBufferAttribute(a,c[2]),ca.getNormal(jl),f[0]=`${Math.round(M.x*s)},${Math.round(M.y*s)},${Math.round(M.z*s)}`,f[1]=`${Math.round(p.x*s)},${Math.round(p.y*s)},${Math.round(p.z*s)}`,f[2]=`${Math.round(d.x*s)},${Math.round(d.y*s)},${Math.round(d.z*s)}`,!(f[0]===f[1]||f[1]===f[2]||f[2]===f[0]))for(let C=0;C<3;C++){const b=(C+1)%3,R=f[C],D=f[b],A=ca[u[C]],y=ca[u[b]],P=`${R}_${D}`,O=`${D}_${R}`;O in h&&h[O]?(jl.dot(h[O].normal)<=r&&(_.push(A.x,A.y,A.z),_.push(y.x,y.y,y.z)),h[O]=null):P in h||(h[P]={index0:c[C],index1:c[b],normal:jl.clone()})}}for(const x in h)if(h[x]){const{index0:M,index1:p}=h[x];aa.fromBufferAttribute(a,M),la.fromBufferAttribute(a,p),_.push(aa.x,aa.y,aa.z),_.push(la.x,la.y,la.z)}this.setAttribute("position",new Be(_,3))}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}}class Ya extends Sn{constructor(t=.5,e=1,n=32,s=1,r=0,o=Math.PI*2){super(),this.type="RingGeometry",this.parameters={innerRadius:t,outerRadius:e,thetaSegments:n,phiSegments:s,thetaStart:r,thetaLength:o},n=Math.max(3,n),s=Math.max(1,s);const a=[],l=[],c=[],u=[];let f=t;const h=(e-t)/s,_=new $,x=new se;for(let M=0;M<=s;M++){for(let p=0;p<=n;p++){const d=r+p/n*o;_.x=f*Math.cos(d),_.y=f*Math.sin(d),l.push(_.x,_.y,_.z),c.push(0,0,1),x.x=(_.x/e+1)/2,x.y=(_.y/e+1)/2,u.push(x.x,x.y)}f+=h}for(let M=0;M<s;M++){const p=M*(n+1);for(let d=0;d<n;d++){const C=d+p,b=C,R=C+n+1,D=C+n+2,A=C+1;a.push(b,R,A),a.push(R,D,A)}}this.setIndex(a),this.setAttribute("position",new Be(l,3)),this.setAttribute("normal",new Be(c,3)),this.setAttribute("uv",new Be(u,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new Ya(t.innerRadius,t.outerRadius,t.thetaSegments,t.phiSegments,t.thetaStart,t.thetaLength)}}class ja extends Sn{constructor(t=1,e=32,n=16,s=0,r=Math.PI*2,o=0,a=Math.PI){super(),this.type="SphereGeometry",this.parameters={radius:t,widthSegments:e,heightSegments:n,phiStart:s,phiLength:r,thetaStart:o,thetaLength:a},e=Math.max(3,Math.floor(e)),n=Math.max(2,Math.floor(n));const l=Math.min(o+a,Math.PI);let c=0;const u=[],f=new $,h=new $,_=[],x=[],M=[],p=[];for(let d=0;d<=n;d++){const C=[],b=d/n;let R=0;d===0&&o===0?R=.5/e:d===n&&l===Math.PI&&(R=-.5/e);for(let D=0;D<=e;D++){const A=D/e;f.x=-t*Math.cos(s+A*r)*Math.sin(o+b*a),f.y=t*Math.cos(o+b*a),f.z=t*Math.sin(s+A*r)*Math.sin(o+b*a),x.push(f.x,f.y,f.z),h.copy(f).normalize(),M.push(h.x,h.y,h.z),p.push(A+R,1-b),C.push(c++)}u.push(C)}for(let d=0;d<n;d++)for(let C=0;C<e;C++){const b=u[d][C+1],R=u[d][C],D=u[d+1][C],A=u[d+1][C+1];(d!==0||o>0)&&_.push(b,R,A),(d!==n-1||l<Math.PI)&&_.push(R,D,A)}this.setIndex(_),this.setAttribute("position",new Be(x,3)),this.setAttribute("normal",new Be(M,3)),this.setAttribute("uv",new Be(p,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new ja(t.radius,t.widthSegments,t.heightSegments,t.phiStart,t.phiLength,t.thetaStart,t.thetaLength)}}class Ch extends Sn{constructor(t=1,e=.4,n=12,s=48,r=Math.PI*2){super(),this.type="TorusGeometry",this.parameters={radius:t,tube:e,radialSegments:n,tubularSegments:s,arc:r},n=Math.floor(n),s=Math.floor(s);const o=[],a=[],l=[],c=[],u=new $,f=new $,h=new $;for(let _=0;_<=n;_++)for(let x=0;x<=s;x++){const M=x/s*r,p=_/n*Math.PI*2;f.x=(t+e*Math.cos(p))*Math.cos(M),f.y=(t+e*Math.cos(p))*Math.sin(M),f.z=e*Math.sin(p),a.push(f.x,f.y,f.z),u.x=t*Math.cos(M),u.y=t*Math.sin(M),h.subVectors(f,u).normalize(),l.push(h.x,h.y,h.z),c.push(x/s),c.push(_/n)}for(let _=1;_<=n;_++)for(let x=1;x<=s;x++){const M=(s+1)*_+x-1,p=(s+1)*(_-1)+x-1,d=(s+1)*(_-1)+x,C=(s+1)*_+x;o.push(M,p,C),o.push(p,d,C)}this.setIndex(o),this.setAttribute("position",new Be(a,3)),this.setAttribute("normal",new Be(l,3)),this.setAttribute("uv",new Be(c,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new Ch(t.radius,t.tube,t.radialSegments,t.tubularSegments,t.arc)}}class Ph extends Fr{constructor(t){super(),this.isMeshLambertMaterial=!0,this.type="MeshLambertMaterial",this.color=new ee(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.emissive=new ee(0),this.emissiveIntensity=1,this.emissiveMap=null,this.bumpMap=null,this.bumpScale=1,this.normalMap=null,this.normalMapType=jd,this.normalScale=new se(1,1),this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new bi,this.combine=gh,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.flatShading=!1,this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.emissive.copy(t.emissive),this.emissiveMap=t.emissiveMap,this.emissiveIntensity=t.emissiveIntensity,this.bumpMap=t.bumpMap,this.bumpScale=t.bumpScale,this.normalMap=t.normalMap,this.normalMapType=t.normalMapType,this.normalScale.copy(t.normalScale),this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.combine=t.combine,this.reflectivity=t.reflectivity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.flatShading=t.flatShading,this.fog=t.fog,this}}class dp extends fn{constructor(t,e=1){super(),this.isLight=!0,this.type="Light",this.color=new ee(t),this.intensity=e}dispose(){}copy(t,e){return super.copy(t,e),this.color.copy(t.color),this.intensity=t.intensity,this}toJSON(t){const e=super.toJSON(t);return e.object.color=this.color.getHex(),e.object.intensity=this.intensity,this.groundColor!==void 0&&(e.object.groundColor=this.groundColor.getHex()),this.distance!==void 0&&(e.object.distance=this.distance),this.angle!==void 0&&(e.object.angle=this.angle),this.decay!==void 0&&(e.object.decay=this.decay),this.penumbra!==void 0&&(e.object.penumbra=this.penumbra),this.shadow!==void 0&&(e.object.shadow=this.shadow.toJSON()),this.target!==void 0&&(e.object.target=this.target.uuid),e}}const Kl=new Ge,Ef=new $,wf=new $;class Ly{constructor(t){this.camera=t,this.intensity=1,this.bias=0,this.normalBias=0,this.radius=1,this.blurSamples=8,this.mapSize=new se(512,512),this.map=null,this.mapPass=null,this.matrix=new Ge,this.autoUpdate=!0,this.needsUpdate=!1,this._frustum=new bh,this._frameExtents=new se(1,1),this._viewportCount=1,this._viewports=[new Ye(0,0,1,1)]}getViewportCount(){return this._viewportCount}getFrustum(){return this._frustum}updateMatrices(t){const e=this.camera,n=this.matrix;Ef.setFromMatrixPosition(t.matrixWorld),e.position.copy(Ef),wf.setFromMatrixPosition(t.target.matrixWorld),e.lookAt(wf),e.updateMatrixWorld(),Kl.multiplyMatrices(e.projectionMatrix,e.matrixWorldInverse),this._frustum.setFromProjectionMatrix(Kl),n.set(.5,0,0,.5,0,.5,0,.5,0,0,.5,.5,0,0,0,1),n.multiply(Kl)}getViewport(t){return this._viewports[t]}getFrameExtents(){return this._frameExtents}dispose(){this.map&&this.map.dispose(),this.mapPass&&this.mapPass.dispose()}copy(t){return this.camera=t.camera.clone(),this.intensity=t.intensity,this.bias=t.bias,this.radius=t.radius,this.mapSize.copy(t.mapSize),this}clone(){return new this.constructor().copy(this)}toJSON(){const t={};return this.intensity!==1&&(t.intensity=this.intensity),this.bias!==0&&(t.bias=this.bias),this.normalBias!==0&&(t.normalBias=this.normalBias),this.radius!==1&&(t.radius=this.radius),(this.mapSize.x!==512||this.mapSize.y!==512)&&(t.mapSize=this.mapSize.toArray()),t.camera=this.camera.toJSON(!1).object,delete t.camera.matrix,t}}class Dy extends Ly{constructor(){super(new ap(-5,5,5,-5,.5,500)),this.isDirectionalLightShadow=!0}}class Iy extends dp{constructor(t,e){super(t,e),this.isDirectionalLight=!0,this.type="DirectionalLight",this.position.copy(fn.DEFAULT_UP),this.updateMatrix(),this.target=new fn,this.shadow=new Dy}dispose(){this.shadow.dispose()}copy(t){return super.copy(t),this.target=t.target.clone(),this.shadow=t.shadow.clone(),this}}class Uy extends dp{constructor(t,e){super(t,e),this.isAmbientLight=!0,this.type="AmbientLight"}}class bf{constructor(t=1,e=0,n=0){return this.radius=t,this.phi=e,this.theta=n,this}set(t,e,n){return this.radius=t,this.phi=e,this.theta=n,this}copy(t){return this.radius=t.radius,this.phi=t.phi,this.theta=t.theta,this}makeSafe(){return this.phi=Math.max(1e-6,Math.min(Math.PI-1e-6,this.phi)),this}setFromVector3(t){return this.setFromCartesianCoords(t.x,t.y,t.z)}setFromCartesianCoords(t,e,n){return this.radius=Math.sqrt(t*t+e*e+n*n),this.radius===0?(this.theta=0,this.phi=0):(this.theta=Math.atan2(t,n),this.phi=Math.acos(Rn(e/this.radius,-1,1))),this}clone(){return new this.constructor().copy(this)}}class Ny extends Rh{constructor(t=10,e=10,n=4473924,s=8947848){n=new ee(n),s=new ee(s);const r=e/2,o=t/e,a=t/2,l=[],c=[];for(let h=0,_=0,x=-a;h<=e;h++,x+=o){l.push(-a,0,x,a,0,x),l.push(x,0,-a,x,0,a);const M=h===r?n:s;M.toArray(c,_),_+=3,M.toArray(c,_),_+=3,M.toArray(c,_),_+=3,M.toArray(c,_),_+=3}const u=new Sn;u.setAttribute("position",new Be(l,3)),u.setAttribute("color",new Be(c,3));const f=new Ao({vertexColors:!0,toneMapped:!1});super(u,f),this.type="GridHelper"}dispose(){this.geometry.dispose(),this.material.dispose()}}const Tf=new $;let ha,$l;class ky extends fn{constructor(t=new $(0,0,1),e=new $(0,0,0),n=1,s=16776960,r=n*.2,o=r*.2){super(),this.type="ArrowHelper",ha===void 0&&(ha=new Sn,ha.setAttribute("position",new Be([0,0,0,0,1,0],3)),$l=new qa(0,.5,1,5,1),$l.translate(0,-.5,0)),this.position.copy(e),this.line=new Ah(ha,new Ao({color:s,toneMapped:!1})),this.line.matrixAutoUpdate=!1,this.add(this.line),this.cone=new sn($l,new Br({color:s,toneMapped:!1})),this.cone.matrixAutoUpdate=!1,this.add(this.cone),this.setDirection(t),this.setLength(n,r,o)}setDirection(t){if(t.y>.99999)this.quaternion.set(0,0,0,1);else if(t.y<-.99999)this.quaternion.set(1,0,0,0);else{Tf.set(t.z,0,-t.x).normalize();const e=Math.acos(t.y);this.quaternion.setFromAxisAngle(Tf,e)}}setLength(t,e=t*.2,n=e*.2){this.line.scale.set(1,Math.max(1e-4,t-e),1),this.line.updateMatrix(),this.cone.scale.set(n,e,n),this.cone.position.y=t,this.cone.updateMatrix()}setColor(t){this.line.material.color.set(t),this.cone.material.color.set(t)}copy(t){return super.copy(t,!1),this.line.copy(t.line),this.cone.copy(t.cone),this}dispose(){this.line.geometry.dispose(),this.line.material.dispose(),this.cone.geometry.dispose(),this.cone.material.dispose()}}class Oy extends Bs{constructor(t,e=null){super(),this.object=t,this.domElement=e,this.enabled=!0,this.state=-1,this.keys={},this.mouseButtons={LEFT:null,MIDDLE:null,RIGHT:null},this.touches={ONE:null,TWO:null}}connect(){}disconnect(){}dispose(){}update(){}}typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("register",{detail:{revision:mh}}));typeof window<"u"&&(window.__THREE__?console.warn("WARNING: Multiple instances of Three.js being imported."):window.__THREE__=mh);const Zl=["#0072b2","#e69f00","#009e73","#cc79a7","#56b4e9","#d55e00","#8b6bd6","#7a8b00"];function Oa(i){return Zl[i%Zl.length]??Zl[0]}function Af(i){const t=getComputedStyle(i),e=(n,s)=>t.getPropertyValue(n).trim()||s;return{background:new ee(e("--picture","#eef2f5")),grid:new ee(e("--picture-grid","#c3ccd4")),wall:new ee(e("--picture-wall","#8b98a5")),tissue:new ee(e("--picture-tissue","#d98a86")),tool:new ee(e("--picture-tool","#33414e")),contact:new ee(e("--picture-contact","#c2410c")),limit:new ee(e("--red","#b42318")),text:e("--text","#16212b"),label:e("--surface","#ffffff")}}const Rf=i=>i===null?wi:i.map(t=>en(t*1e3,1)).join(" "),Cf=i=>i===null?wi:en(Math.hypot(...i),2);function Ka(i){return Si("svg",{class:"swatch",viewBox:"0 0 10 10","aria-hidden":"true"},Si("rect",{width:10,height:10,rx:3,fill:Oa(i)}))}class Fy{constructor(t,e){this.page=t,this.slot=z("div",{class:"slot large"}),this.rows=z("tbody"),this.cells=[],this.known=null,this.camera=ti([],"free",r=>e?.rig.choose(r));const n=r=>uc(H(`picture.${r}`),e?.options[r]??!1,o=>{e&&(e.options[r]=o)}),s=["what","position","force","authority"].map(r=>z("th",{scope:"col"},H(`values.${r}`)));this.node=z("div",{class:"view live-view"},this.slot,z("div",{class:"side"},Vn(H("picture.camera"),"camera-panel",qe(H("picture.camera"),this.camera),z("div",{class:"checks"},n("trails"),n("forces"),n("names"))),Vn(H("picture.values"),"values-panel",z("div",{class:"scroll",tabindex:0,role:"group","aria-label":H("picture.values")},z("table",{},z("thead",{},z("tr",{},...s)),this.rows)))))}shown(){this.slot.append(this.page.pictureHost)}update(){const{scene:t,state:e}=this.page.model;if(!t||!e)return;t!==this.known&&this.adopt(t);const n=t.seats.flatMap((s,r)=>s.kind==="MASTER"?[r]:[]);e.seats.forEach((s,r)=>{const o=n.indexOf(r),a=o<0?[]:e.tools.map(l=>gr(l.applied?.[o]));this.set(r,[Rf(s.x),Cf(s.f),a.join(" · ")||wi])}),e.tools.forEach((s,r)=>{const o=s.touching?H("values.depth",{mm:en((s.depth_m??NaN)*1e3,1,"mm")}):"";this.set(t.seats.length+r,[Rf(s.x),Cf(s.f),o])})}set(t,e){e.forEach((n,s)=>{const r=this.cells[t]?.[s];r&&Se(r,n)})}adopt(t){this.known=t;const e=t.seats.flatMap((s,r)=>s.kind==="MASTER"?[[`seat:${r}`,s.name]]:[]);Us(this.camera,[["free",H("camera.free")],["front",H("camera.front")],["above",H("camera.above")],...e.map(([s,r])=>[s,H("camera.seat",{seat:r})])],this.camera.value||"free");const n=[...t.seats.map((s,r)=>[Ka(r),s.name]),...t.tools.map(s=>[null,s.name])];this.cells=n.map(()=>[z("td"),z("td"),z("td")]),this.rows.replaceChildren(...n.map(([s,r],o)=>z("tr",{},z("th",{scope:"row"},s,r),...this.cells[o]??[])))}}class By{constructor(t){this.page=t,this.tools=ti([["0",""]],"0",()=>this.discard()),this.toolField=qe(H("authority.tool"),this.tools),this.rows=z("div",{class:"shares"}),this.presets=z("div",{class:"row presets"}),this.to=ti([],"",()=>{}),this.share=z("input",{type:"number",min:5,max:100,step:5,value:"100"}),this.transfer=z("p",{class:"transfer",role:"status"}),this.draftNote=z("p",{class:"note"}),this.sliders=[],this.masters=[],this.known=null,this.draft=null,this.apply=Fe(H("authority.apply"),()=>this.send(H("authority.title"),this.draft),{class:"primary"}),this.reset=Fe(H("authority.reset"),()=>this.discard()),this.give=Fe(H("authority.give"),()=>this.handOver()),this.node=Vn(H("authority.title"),"authority-panel",this.toolField,this.rows,z("div",{class:"row"},this.apply,this.reset,this.draftNote),z("h3",{},H("authority.presets")),this.presets,z("h3",{},H("authority.hand_over")),z("div",{class:"row"},qe(H("who.seat"),this.to),qe(`${H("authority.share")} (%)`,this.share),this.give),this.transfer,z("p",{class:"note"},H("authority.explain",{ticks:vg})))}update(){const{model:t}=this.page;t.scene&&t.scene!==this.known&&this.adopt(t.scene);const e=t.state?.tools[this.tool()],n=e?.wanted??null,s=e?.applied??null;Mg(this.draft,n)&&(this.draft=null);const r=t.may("authority")&&n!==null;this.sliders.forEach((a,l)=>{const c=(this.draft??n)?.[l];(this.draft===null&&document.activeElement!==a.slider&&c!==void 0||this.draft!==null&&c!==void 0)&&(a.slider.value=String(Math.round(c*100))),a.slider.setAttribute("aria-valuetext",gr(c)),Se(a.draft,gr(c)),Se(a.wanted,gr(n?.[l])),Se(a.applied,gr(s?.[l])),a.bar.value=s?.[l]??0,Te(a.slider,!r)}),Se(this.draftNote,this.draft?H("authority.draft"):""),Te(this.apply,!r||this.draft===null),Te(this.reset,this.draft===null),Te(this.give,!r||this.masters.length<2),Te(this.to,!r),Te(this.share,!r),this.toolField.hidden=this.tools.options.length<2;for(const a of this.presets.children)Te(a,!r);const o=e?.transfer??null;Se(this.transfer,o?H("authority.transfer",{by:o.by,to:o.to,alpha:gr(o.alpha),ticks:o.ticks??wi}):H("authority.no_transfer")),this.transfer.classList.toggle("announced",o!==null)}tool(){return Number(this.tools.value)||0}discard(){this.draft=null,this.update()}handOver(){const t=Number(this.to.value),e=Math.min(100,Math.max(0,Number(this.share.value)))/100,n=this.page.model.state?.tools[this.tool()]?.wanted;!n||Number.isNaN(e)||this.send(H("authority.give"),Su(n,t,e))}send(t,e){const n=this.page.model.state?.version;!e||n===void 0||this.page.order(t,{order:"authority",tool:this.tool(),version:n,alpha:e}).then(s=>{s.ok&&(this.draft=null)})}adopt(t){this.known=t,this.draft=null,this.masters=Dd(t),Us(this.tools,t.tools.map((r,o)=>[String(o),r.name]),this.tools.value);const e=ph(this.masters);Us(this.to,this.masters.map((r,o)=>[String(o),r.name]),String(Ca(this.masters)[0]??0)),this.sliders=[],this.rows.replaceChildren(z("div",{class:"share head","aria-hidden":"true"},z("span"),z("span"),z("span"),z("span",{},H("authority.wanted")),z("span",{},H("authority.applied"))),...this.masters.map((r,o)=>this.row(r,o,t)));const n=r=>()=>this.preset(Id(this.masters.length,r)),s=H("authority.demonstration");this.presets.replaceChildren(Fe(s,n(e)),Fe(H("authority.guidance"),()=>this.preset(xg(this.masters))),...Ca(this.masters).map(r=>Fe(H("authority.evaluation",{seat:this.masters[r]?.name??""}),n(r))))}preset(t){this.send(H("authority.presets"),t)}row(t,e,n){const s=z("input",{type:"range",min:0,max:100,step:5,"aria-label":H("authority.share_of",{seat:t.name}),oninput:()=>{const u=this.draft??this.page.model.state?.tools[this.tool()]?.wanted;u&&(this.draft=Su(u,e,Number(s.value)/100)),this.update()}}),r=z("progress",{max:1,"aria-label":`${t.name}: ${H("authority.applied")}`}),[o,a,l]=[z("span",{class:"draft"}),z("span"),z("span")];this.sliders.push({slider:s,draft:o,wanted:a,applied:l,bar:r});const c=u=>z("span",{class:"visually-hidden"},`${u}: `);return z("div",{class:"share"},z("span",{class:"name"},Ka(n.seats.indexOf(t)),t.name),s,o,z("span",{class:"number"},c(H("authority.wanted")),a),z("span",{class:"number applied"},c(H("authority.applied")),l,r))}}const pp={green:20,amber:100},Lh={green:5,amber:50},mp={green:.1,amber:10},zy=Lh,Hy=.8,Gy=.999,Pf=["unknown","green","amber","red"];function Ls(i,t){return i===null||!Number.isFinite(i)?"unknown":i<=t.green?"green":i<=t.amber?"amber":"red"}function gp(i){return i.reduce((t,e)=>Pf.indexOf(e)>Pf.indexOf(t)?e:t,"unknown")}function Dh(i){return i.f===null?null:Math.hypot(...i.f)}function Ih(i,t){const e=Dh(i),n=t?.force_limit_n??null;return e===null||n===null||!(n>0)?null:e/n}function _p(i){return i===null?"unknown":i>=Gy?"red":i>=Hy?"amber":"green"}function Uh(i,t){return _p(Ih(i,t))==="red"}function vp(i){return i===null?"unknown":i>.005?"green":i>0?"amber":"red"}function xp(i){return i===null?"unknown":i==="LATCHED"||i==="FAULT"?"red":i==="ON"?"green":"amber"}function Mp(i){return i===null?"unknown":i<50?"green":i<65?"amber":"red"}function th(i){return gp([Ls(i.rtt_ms,pp),Ls(i.loss_percent,mp),Ls(i.gap_ms,Lh)])}class yo{constructor(t){if(this.capacity=t,this.entries=[],this.begin=0,!Number.isInteger(t)||t<1)throw new RangeError(`capacity ${t}: allowed are integers >= 1`)}get length(){return this.entries.length-this.begin}get newest(){return this.length>0?this.entries[this.entries.length-1]:void 0}push(t){this.entries.push(t),this.length>this.capacity&&(this.begin+=1),this.compact()}dropWhile(t){for(let e=this.entries[this.begin];e!==void 0&&t(e);e=this.entries[this.begin])this.begin+=1;this.compact()}at(t){return t<0?void 0:this.entries[this.begin+t]}clear(){this.entries=[],this.begin=0}toArray(){return this.entries.slice(this.begin)}compact(){this.begin<=this.capacity||(this.entries=this.entries.slice(this.begin),this.begin=0)}}const eh=60,ua=4,yp=["force","rtt","loss","margin"],ao={force:Dh,rtt:i=>i.rtt_ms,loss:i=>i.loss_percent,margin:i=>i.margin_j};class Vy{constructor(){this.rows=null,this.ring=new yo(eh*ua)}clear(){this.ring.clear(),this.rows=null}update(t,e){if(e&&e.seats.length!==t.seats.length)return;const n=Math.floor(t.t*ua);if(this.rows&&(n<Math.floor(this.rows.t*ua)||this.rows.seats.length!==t.seats.length)&&this.clear(),this.rows&&Math.floor(this.rows.t*ua)===n){const s=this.rows;t.seats.forEach((r,o)=>{const a=s.seats[o];if(a)for(const l of yp)a[l]=Wy(l,a[l],ao[l](r))});return}this.rows={t:t.t,seats:t.seats.map(s=>({force:ao.force(s),rtt:ao.rtt(s),loss:ao.loss(s),margin:ao.margin(s)}))},this.ring.push(this.rows),this.ring.dropWhile(s=>t.t-s.t>eh)}get samples(){return this.ring.length}series(t,e){const n=this.ring.newest?.t??0,s=this.ring.toArray();return[s.map(r=>r.t-n),s.map(r=>r.seats[t]?.[e]??null)]}}function Wy(i,t,e){return t===null||e===null?t??e:i==="margin"?Math.min(t,e):Math.max(t,e)}const Xy=!0,an="u-",qy="uplot",Yy=an+"hz",jy=an+"vt",Ky=an+"title",$y=an+"wrap",Zy=an+"under",Jy=an+"over",Qy=an+"axis",Rs=an+"off",tS=an+"select",eS=an+"cursor-x",nS=an+"cursor-y",iS=an+"cursor-pt",sS=an+"legend",rS=an+"live",oS=an+"inline",aS=an+"series",lS=an+"marker",Lf=an+"label",cS=an+"value",uo="width",fo="height",lo="top",Df="bottom",pr="left",Jl="right",Nh="#000",If=Nh+"0",Uf="mousemove",Nf="mousedown",Ql="mouseup",kf="mouseenter",Of="mouseleave",Ff="dblclick",hS="resize",uS="scroll",Bf="change",Fa="dppxchange",kh="--",Gr=typeof window<"u",nh=Gr?document:null,Tr=Gr?window:null,fS=Gr?navigator:null;let xe,fa;function ih(){let i=devicePixelRatio;xe!=i&&(xe=i,fa&&rh(Bf,fa,ih),fa=matchMedia(`(min-resolution: ${xe-.001}dppx) and (max-resolution: ${xe+.001}dppx)`),Is(Bf,fa,ih),Tr.dispatchEvent(new CustomEvent(Fa)))}function zn(i,t){if(t!=null){let e=i.classList;!e.contains(t)&&e.add(t)}}function sh(i,t){let e=i.classList;e.contains(t)&&e.remove(t)}function ke(i,t,e){i.style[t]=e+"px"}function li(i,t,e,n){let s=nh.createElement(i);return t!=null&&zn(s,t),e?.insertBefore(s,n),s}function jn(i,t){return li("div",i,t)}const zf=new WeakMap;function xi(i,t,e,n,s){let r="translate("+t+"px,"+e+"px)",o=zf.get(i);r!=o&&(i.style.transform=r,zf.set(i,r),t<0||e<0||t>n||e>s?zn(i,Rs):sh(i,Rs))}const Hf=new WeakMap;function Gf(i,t,e){let n=t+e,s=Hf.get(i);n!=s&&(Hf.set(i,n),i.style.background=t,i.style.borderColor=e)}const Vf=new WeakMap;function Wf(i,t,e,n){let s=t+""+e,r=Vf.get(i);s!=r&&(Vf.set(i,s),i.style.height=e+"px",i.style.width=t+"px",i.style.marginLeft=n?-t/2+"px":0,i.style.marginTop=n?-e/2+"px":0)}const Oh={passive:!0},dS={...Oh,capture:!0};function Is(i,t,e,n){t.addEventListener(i,e,n?dS:Oh)}function rh(i,t,e,n){t.removeEventListener(i,e,Oh)}Gr&&ih();function ci(i,t,e,n){let s;e=e||0,n=n||t.length-1;let r=n<=2147483647;for(;n-e>1;)s=r?e+n>>1:Gn((e+n)/2),t[s]<i?e=s:n=s;return i-t[e]<=t[n]-i?e:n}function Ir(i,t,e,n){for(let s=n==1?t:e;s>=t&&s<=e;s+=n)if(i[s]!=null)return s;return-1}function pS(i,t,e,n){let s=ue,r=-ue;if(n==1)s=i[t],r=i[e];else if(n==-1)s=i[e],r=i[t];else for(let o=t;o<=e;o++){let a=i[o];a!=null&&(a<s&&(s=a),a>r&&(r=a))}return[s,r]}function mS(i,t,e){let n=ue,s=-ue;for(let r=t;r<=e;r++){let o=i[r];o!=null&&o>0&&(o<n&&(n=o),o>s&&(s=o))}return[n,s]}function $a(i,t,e,n){let s=Yf(i),r=Yf(t);i==t&&(s==-1?(i*=e,t/=e):(i/=e,t*=e));let o=e==10?Bi:Sp,a=s==1?Gn:Kn,l=r==1?Kn:Gn,c=a(o(nn(i))),u=l(o(nn(t))),f=Ur(e,c),h=Ur(e,u);return e==10&&(c<0&&(f=Pe(f,-c)),u<0&&(h=Pe(h,-u))),n||e==2?(i=f*s,t=h*r):(i=bp(i,f),t=Za(t,h)),[i,t]}function Fh(i,t,e,n){let s=$a(i,t,e,n);return i==0&&(s[0]=0),t==0&&(s[1]=0),s}const Bh=.1,Xf={mode:3,pad:Bh},go={pad:0,soft:null,mode:0},gS={min:go,max:go};function Ba(i,t,e,n){return Ja(e)?qf(i,t,e):(go.pad=e,go.soft=n?0:null,go.mode=n?3:0,qf(i,t,gS))}function ve(i,t){return i??t}function _S(i,t,e){for(t=ve(t,0),e=ve(e,i.length-1);t<=e;){if(i[t]!=null)return!0;t++}return!1}function qf(i,t,e){let n=e.min,s=e.max,r=ve(n.pad,0),o=ve(s.pad,0),a=ve(n.hard,-ue),l=ve(s.hard,ue),c=ve(n.soft,ue),u=ve(s.soft,-ue),f=ve(n.mode,0),h=ve(s.mode,0),_=t-i,x=Bi(_),M=Mn(nn(i),nn(t)),p=Bi(M),d=nn(p-x);(_<1e-24||d>10)&&(_=0,(i==0||t==0)&&(_=1e-24,f==2&&c!=ue&&(r=0),h==2&&u!=-ue&&(o=0)));let C=_||M||1e3,b=Bi(C),R=Ur(10,Gn(b)),D=C*(_==0?i==0?.1:1:r),A=Pe(bp(i-D,R/10),24),y=i>=c&&(f==1||f==3&&A<=c||f==2&&A>=c)?c:ue,P=Mn(a,A<y&&i>=y?y:Jn(y,A)),O=C*(_==0?t==0?.1:1:o),g=Pe(Za(t+O,R/10),24),m=t<=u&&(h==1||h==3&&g>=u||h==2&&g<=u)?u:-ue,E=Jn(l,g>m&&t<=m?m:Mn(m,g));return P==E&&P==0&&(E=100),[P,E]}const vS=new Intl.NumberFormat(Gr?fS.language:"en-US"),zh=i=>vS.format(i),Wn=Math,Ta=Wn.PI,nn=Wn.abs,Gn=Wn.floor,tn=Wn.round,Kn=Wn.ceil,Jn=Wn.min,Mn=Wn.max,Ur=Wn.pow,Yf=Wn.sign,Bi=Wn.log10,Sp=Wn.log2,xS=(i,t=1)=>Wn.sinh(i)*t,tc=(i,t=1)=>Wn.asinh(i/t),ue=1/0;function jf(i){return(Bi((i^i>>31)-(i>>31))|0)+1}function oh(i,t,e){return Jn(Mn(i,t),e)}function he(i){return typeof i=="function"?i:()=>i}const MS=()=>{},Ep=i=>i,wp=(i,t)=>t,yS=i=>null,Kf=i=>!0,$f=(i,t)=>i==t,SS=/\.\d*?(?=9{6,}|0{6,})/gm,Fs=i=>{if(Ap(i)||us.has(i))return i;const t=`${i}`,e=t.match(SS);if(e==null)return i;let n=e[0].length-1;if(t.indexOf("e-")!=-1){let[s,r]=t.split("e");return+`${Fs(s)}e${r}`}return Pe(i,n)};function ws(i,t){return Fs(Pe(Fs(i/t))*t)}function Za(i,t){return Fs(Kn(Fs(i/t))*t)}function bp(i,t){return Fs(Gn(Fs(i/t))*t)}function Pe(i,t=0){if(Ap(i))return i;let e=10**t,n=i*e*(1+Number.EPSILON);return tn(n)/e}const us=new Map;function Tp(i){return((""+i).split(".")[1]||"").length}function So(i,t,e,n){let s=[],r=n.map(Tp);for(let o=t;o<e;o++){let a=nn(o),l=Pe(Ur(i,o),a);for(let c=0;c<n.length;c++){let u=i==10?+`${n[c]}e${o}`:n[c]*l,f=(o>=0?0:a)+(o>=r[c]?0:r[c]),h=i==10?u:Pe(u,f);s.push(h),us.set(h,f)}}return s}const _o={},Hh=[],Nr=[null,null],ts=Array.isArray,Ap=Number.isInteger,ES=i=>i===void 0;function Zf(i){return typeof i=="string"}function Ja(i){let t=!1;if(i!=null){let e=i.constructor;t=e==null||e==Object}return t}function wS(i){return i!=null&&typeof i=="object"}const bS=Object.getPrototypeOf(Uint8Array),Rp="__proto__";function kr(i,t=Ja){let e;if(ts(i)){let n=i.find(s=>s!=null);if(ts(n)||t(n)){e=Array(i.length);for(let s=0;s<i.length;s++)e[s]=kr(i[s],t)}else e=i.slice()}else if(i instanceof bS)e=i.slice();else if(t(i)){e={};for(let n in i)n!=Rp&&(e[n]=kr(i[n],t))}else e=i;return e}function Je(i){let t=arguments;for(let e=1;e<t.length;e++){let n=t[e];for(let s in n)s!=Rp&&(Ja(i[s])?Je(i[s],kr(n[s])):i[s]=kr(n[s]))}return i}const TS=0,AS=1,RS=2;function CS(i,t,e){for(let n=0,s,r=-1;n<t.length;n++){let o=t[n];if(o>r){for(s=o-1;s>=0&&i[s]==null;)i[s--]=null;for(s=o+1;s<e&&i[s]==null;)i[r=s++]=null}}}function PS(i,t){if(IS(i)){let o=i[0].slice();for(let a=1;a<i.length;a++)o.push(...i[a].slice(1));return US(o[0])||(o=DS(o)),o}let e=new Set;for(let o=0;o<i.length;o++){let l=i[o][0],c=l.length;for(let u=0;u<c;u++)e.add(l[u])}let n=[Array.from(e).sort((o,a)=>o-a)],s=n[0].length,r=new Map;for(let o=0;o<s;o++)r.set(n[0][o],o);for(let o=0;o<i.length;o++){let a=i[o],l=a[0];for(let c=1;c<a.length;c++){let u=a[c],f=Array(s).fill(void 0),h=t?t[o][c]:AS,_=[];for(let x=0;x<u.length;x++){let M=u[x],p=r.get(l[x]);M===null?h!=TS&&(f[p]=M,h==RS&&_.push(p)):f[p]=M}CS(f,_,s),n.push(f)}}return n}const LS=typeof queueMicrotask>"u"?i=>Promise.resolve().then(i):queueMicrotask;function DS(i){let t=i[0],e=t.length,n=Array(e);for(let r=0;r<n.length;r++)n[r]=r;n.sort((r,o)=>t[r]-t[o]);let s=[];for(let r=0;r<i.length;r++){let o=i[r],a=Array(e);for(let l=0;l<e;l++)a[l]=o[n[l]];s.push(a)}return s}function IS(i){let t=i[0][0],e=t.length;for(let n=1;n<i.length;n++){let s=i[n][0];if(s.length!=e)return!1;if(s!=t){for(let r=0;r<e;r++)if(s[r]!=t[r])return!1}}return!0}function US(i,t=100){const e=i.length;if(e<=1)return!0;let n=0,s=e-1;for(;n<=s&&i[n]==null;)n++;for(;s>=n&&i[s]==null;)s--;if(s<=n)return!0;const r=Mn(1,Gn((s-n+1)/t));for(let o=i[n],a=n+r;a<=s;a+=r){const l=i[a];if(l!=null){if(l<=o)return!1;o=l}}return!0}const Cp=["January","February","March","April","May","June","July","August","September","October","November","December"],Pp=["Sunday","Monday","Tuesday","Wednesday","Thursday","Friday","Saturday"];function Lp(i){return i.slice(0,3)}const NS=Pp.map(Lp),kS=Cp.map(Lp),OS={MMMM:Cp,MMM:kS,WWWW:Pp,WWW:NS};function co(i){return(i<10?"0":"")+i}function FS(i){return(i<10?"00":i<100?"0":"")+i}const BS={YYYY:i=>i.getFullYear(),YY:i=>(i.getFullYear()+"").slice(2),MMMM:(i,t)=>t.MMMM[i.getMonth()],MMM:(i,t)=>t.MMM[i.getMonth()],MM:i=>co(i.getMonth()+1),M:i=>i.getMonth()+1,DD:i=>co(i.getDate()),D:i=>i.getDate(),WWWW:(i,t)=>t.WWWW[i.getDay()],WWW:(i,t)=>t.WWW[i.getDay()],HH:i=>co(i.getHours()),H:i=>i.getHours(),h:i=>{let t=i.getHours();return t==0?12:t>12?t-12:t},AA:i=>i.getHours()>=12?"PM":"AM",aa:i=>i.getHours()>=12?"pm":"am",a:i=>i.getHours()>=12?"p":"a",mm:i=>co(i.getMinutes()),m:i=>i.getMinutes(),ss:i=>co(i.getSeconds()),s:i=>i.getSeconds(),fff:i=>FS(i.getMilliseconds())};function Gh(i,t){t=t||OS;let e=[],n=/\{([a-z]+)\}|[^{]+/gi,s;for(;s=n.exec(i);)e.push(s[0][0]=="{"?BS[s[1]]:s[0]);return r=>{let o="";for(let a=0;a<e.length;a++)o+=typeof e[a]=="string"?e[a]:e[a](r,t);return o}}const zS=new Intl.DateTimeFormat().resolvedOptions().timeZone;function HS(i,t){let e;return t=="UTC"||t=="Etc/UTC"?e=new Date(+i+i.getTimezoneOffset()*6e4):t==zS?e=i:(e=new Date(i.toLocaleString("en-US",{timeZone:t})),e.setMilliseconds(i.getMilliseconds())),e}const Dp=i=>i%1==0,za=[1,2,2.5,5],GS=So(10,-32,0,za),Ip=So(10,0,32,za),VS=Ip.filter(Dp),bs=GS.concat(Ip),Vh=`
`,Up="{YYYY}",Jf=Vh+Up,Np="{M}/{D}",po=Vh+Np,da=po+"/{YY}",kp="{aa}",WS="{h}:{mm}",_r=WS+kp,Qf=Vh+_r,td=":{ss}",Me=null;function Op(i){let t=i*1e3,e=t*60,n=e*60,s=n*24,r=s*30,o=s*365,l=(i==1?So(10,0,3,za).filter(Dp):So(10,-3,0,za)).concat([t,t*5,t*10,t*15,t*30,e,e*5,e*10,e*15,e*30,n,n*2,n*3,n*4,n*6,n*8,n*12,s,s*2,s*3,s*4,s*5,s*6,s*7,s*8,s*9,s*10,s*15,r,r*2,r*3,r*4,r*6,o,o*2,o*5,o*10,o*25,o*50,o*100]);const c=[[o,Up,Me,Me,Me,Me,Me,Me,1],[s*28,"{MMM}",Jf,Me,Me,Me,Me,Me,1],[s,Np,Jf,Me,Me,Me,Me,Me,1],[n,"{h}"+kp,da,Me,po,Me,Me,Me,1],[e,_r,da,Me,po,Me,Me,Me,1],[t,td,da+" "+_r,Me,po+" "+_r,Me,Qf,Me,1],[i,td+".{fff}",da+" "+_r,Me,po+" "+_r,Me,Qf,Me,1]];function u(f){return(h,_,x,M,p,d)=>{let C=[],b=p>=o,R=p>=r&&p<o,D=f(x),A=Pe(D*i,3),y=ec(D.getFullYear(),b?0:D.getMonth(),R||b?1:D.getDate()),P=Pe(y*i,3);if(R||b){let O=R?p/r:0,g=b?p/o:0,m=A==P?A:Pe(ec(y.getFullYear()+g,y.getMonth()+O,1)*i,3),E=new Date(tn(m/i)),N=E.getFullYear(),F=E.getMonth();for(let B=0;m<=M;B++){let G=ec(N+g*B,F+O*B,1),K=G-f(Pe(G*i,3));m=Pe((+G+K)*i,3),m<=M&&C.push(m)}}else{let O=p>=s?s:p,g=Gn(x)-Gn(A),m=P+g+Za(A-P,O);C.push(m);let E=f(m),N=E.getHours()+E.getMinutes()/e+E.getSeconds()/n,F=p/n,B=h.axes[_]._space,G=d/B;for(;m=Pe(m+p,i==1?0:3),!(m>M);)if(F>1){let K=Gn(Pe(N+F,6))%24,ct=f(m).getHours()-K;ct>1&&(ct=-1),m-=ct*n,N=(N+F)%24;let gt=C[C.length-1];Pe((m-gt)/p,3)*G>=.7&&C.push(m)}else C.push(m)}return C}}return[l,c,u]}const[XS,qS,YS]=Op(1),[jS,KS,$S]=Op(.001);So(2,-53,53,[1]);function ed(i,t){return i.map(e=>e.map((n,s)=>s==0||s==8||n==null?n:t(s==1||e[8]==0?n:e[1]+n)))}function nd(i,t){return(e,n,s,r,o)=>{let a=t.find(x=>o>=x[0])||t[t.length-1],l,c,u,f,h,_;return n.map(x=>{let M=i(x),p=M.getFullYear(),d=M.getMonth(),C=M.getDate(),b=M.getHours(),R=M.getMinutes(),D=M.getSeconds(),A=p!=l&&a[2]||d!=c&&a[3]||C!=u&&a[4]||b!=f&&a[5]||R!=h&&a[6]||D!=_&&a[7]||a[1];return l=p,c=d,u=C,f=b,h=R,_=D,A(M)})}}function ZS(i,t){let e=Gh(t);return(n,s,r,o,a)=>s.map(l=>e(i(l)))}function ec(i,t,e){return new Date(i,t,e)}function id(i,t){return t(i)}const JS="{YYYY}-{MM}-{DD} {h}:{mm}{aa}";function sd(i,t){return(e,n,s,r)=>r==null?kh:t(i(n))}function QS(i,t){let e=i.series[t];return e.width?e.stroke(i,t):e.points.width?e.points.stroke(i,t):null}function tE(i,t){return i.series[t].fill(i,t)}const eE={show:!0,live:!0,isolate:!1,mount:MS,markers:{show:!0,width:2,stroke:QS,fill:tE,dash:"solid"},idx:null,idxs:null,values:[]};function nE(i,t){let e=i.cursor.points,n=jn(),s=e.size(i,t);ke(n,uo,s),ke(n,fo,s);let r=s/-2;ke(n,"marginLeft",r),ke(n,"marginTop",r);let o=e.width(i,t,s);return o&&ke(n,"borderWidth",o),n}function iE(i,t){let e=i.series[t].points;return e._fill||e._stroke}function sE(i,t){let e=i.series[t].points;return e._stroke||e._fill}function rE(i,t){return i.series[t].points.size}const nc=[0,0];function oE(i,t,e){return nc[0]=t,nc[1]=e,nc}function pa(i,t,e,n=!0){return s=>{s.button==0&&(!n||s.target==t)&&e(s)}}function ic(i,t,e,n=!0){return s=>{(!n||s.target==t)&&e(s)}}const aE={show:!0,x:!0,y:!0,lock:!1,move:oE,points:{one:!1,show:nE,size:rE,width:0,stroke:sE,fill:iE},bind:{mousedown:pa,mouseup:pa,click:pa,dblclick:pa,mousemove:ic,mouseleave:ic,mouseenter:ic},drag:{setScale:!0,x:!0,y:!1,dist:0,uni:null,click:(i,t)=>{t.stopPropagation(),t.stopImmediatePropagation()},_x:!1,_y:!1},focus:{dist:(i,t,e,n,s)=>n-s,prox:-1,bias:0},hover:{skip:[void 0],prox:null,bias:0},left:-10,top:-10,idx:null,dataIdx:null,idxs:null,event:null},Fp={show:!0,stroke:"rgba(0,0,0,0.07)",width:2},Wh=Je({},Fp,{filter:wp}),Bp=Je({},Wh,{size:10}),zp=Je({},Fp,{show:!1}),Xh='12px system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji"',Hp="bold "+Xh,Gp=1.5,rd={show:!0,scale:"x",stroke:Nh,space:50,gap:5,size:50,labelGap:0,labelSize:30,labelFont:Hp,side:2,grid:Wh,ticks:Bp,border:zp,font:Xh,lineGap:Gp,rotate:0},lE="Value",cE="Time",od={show:!0,scale:"x",auto:!1,sorted:1,min:ue,max:-ue,idxs:[]};function hE(i,t,e,n,s){return t.map(r=>r==null?"":zh(r))}function uE(i,t,e,n,s,r,o){let a=[],l=us.get(s)||0;e=o?e:Pe(Za(e,s),l);for(let c=e;c<=n;c=Pe(c+s,l))a.push(Object.is(c,-0)?0:c);return a}function ah(i,t,e,n,s,r,o){const a=[],l=i.scales[i.axes[t].scale].log,c=l==10?Bi:Sp,u=Gn(c(e));s=Ur(l,u),l==10&&(s=bs[ci(s,bs)]);let f=e,h=s*l;l==10&&(h=bs[ci(h,bs)]);do a.push(f),f=f+s,l==10&&!us.has(f)&&(f=Pe(f,us.get(s))),f>=h&&(s=f,h=s*l,l==10&&(h=bs[ci(h,bs)]));while(f<=n);return a}function fE(i,t,e,n,s,r,o){let l=i.scales[i.axes[t].scale].asinh,c=n>l?ah(i,t,Mn(l,e),n,s):[l],u=n>=0&&e<=0?[0]:[];return(e<-l?ah(i,t,Mn(l,-n),-e,s):[l]).reverse().map(h=>-h).concat(u,c)}const Vp=/./,dE=/[12357]/,pE=/[125]/,ad=/1/,lh=(i,t,e,n)=>i.map((s,r)=>t==4&&s==0||r%n==0&&e.test(s.toExponential()[s<0?1:0])?s:null);function mE(i,t,e,n,s){let r=i.axes[e],o=r.scale,a=i.scales[o],l=i.valToPos,c=r._space,u=l(10,o),f=l(9,o)-u>=c?Vp:l(7,o)-u>=c?dE:l(5,o)-u>=c?pE:ad;if(f==ad){let h=nn(l(1,o)-u);if(h<c)return lh(t.slice().reverse(),a.distr,f,Kn(c/h)).reverse()}return lh(t,a.distr,f,1)}function gE(i,t,e,n,s){let r=i.axes[e],o=r.scale,a=r._space,l=i.valToPos,c=nn(l(1,o)-l(2,o));return c<a?lh(t.slice().reverse(),3,Vp,Kn(a/c)).reverse():t}function _E(i,t,e,n){return n==null?kh:t==null?"":zh(t)}const ld={show:!0,scale:"y",stroke:Nh,space:30,gap:5,size:50,labelGap:0,labelSize:30,labelFont:Hp,side:3,grid:Wh,ticks:Bp,border:zp,font:Xh,lineGap:Gp,rotate:0};function vE(i,t){let e=3+(i||1)*2;return Pe(e*t,3)}function xE(i,t){let{scale:e,idxs:n}=i.series[0],s=i._data[0],r=i.valToPos(s[n[0]],e,!0),o=i.valToPos(s[n[1]],e,!0),a=nn(o-r),l=i.series[t],c=a/(l.points.space*xe);return n[1]-n[0]<=c}const cd={scale:null,auto:!0,sorted:0,min:ue,max:-ue},Wp=(i,t,e,n,s)=>s,hd={show:!0,auto:!0,sorted:0,gaps:Wp,alpha:1,facets:[Je({},cd,{scale:"x"}),Je({},cd,{scale:"y"})]},ud={scale:"y",auto:!0,sorted:0,show:!0,spanGaps:!1,gaps:Wp,alpha:1,points:{show:xE,filter:null},values:null,min:ue,max:-ue,idxs:[],path:null,clip:null};function ME(i,t,e,n,s){return e/10}const Xp={time:Xy,auto:!0,distr:1,log:10,asinh:1,min:null,max:null,dir:1,ori:0},yE=Je({},Xp,{time:!1,ori:1}),fd={};function qp(i,t){let e=fd[i];return e||(e={key:i,plots:[],sub(n){e.plots.push(n)},unsub(n){e.plots=e.plots.filter(s=>s!=n)},pub(n,s,r,o,a,l,c){for(let u=0;u<e.plots.length;u++)e.plots[u]!=s&&e.plots[u].pub(n,s,r,o,a,l,c)}},i!=null&&(fd[i]=e)),e}const Or=1,ch=2;function zs(i,t,e){const n=i.mode,s=i.series[t],r=n==2?i._data[t]:i._data,o=i.scales,a=i.bbox;let l=r[0],c=n==2?r[1]:r[t],u=n==2?o[s.facets[0].scale]:o[i.series[0].scale],f=n==2?o[s.facets[1].scale]:o[s.scale],h=a.left,_=a.top,x=a.width,M=a.height,p=i.valToPosH,d=i.valToPosV;return u.ori==0?e(s,l,c,u,f,p,d,h,_,x,M,tl,Vr,nl,jp,$p):e(s,l,c,u,f,d,p,_,h,M,x,el,Wr,jh,Kp,Zp)}function qh(i,t){let e=0,n=0,s=ve(i.bands,Hh);for(let r=0;r<s.length;r++){let o=s[r];o.series[0]==t?e=o.dir:o.series[1]==t&&(o.dir==1?n|=1:n|=2)}return[e,n==1?-1:n==2?1:n==3?2:0]}function SE(i,t,e,n,s){let r=i.mode,o=i.series[t],a=r==2?o.facets[1].scale:o.scale,l=i.scales[a];return s==-1?l.min:s==1?l.max:l.distr==3?l.dir==1?l.min:l.max:0}function zi(i,t,e,n,s,r){return zs(i,t,(o,a,l,c,u,f,h,_,x,M,p)=>{let d=o.pxRound;const C=c.dir*(c.ori==0?1:-1),b=c.ori==0?Vr:Wr;let R,D;C==1?(R=e,D=n):(R=n,D=e);let A=d(f(a[R],c,M,_)),y=d(h(l[R],u,p,x)),P=d(f(a[D],c,M,_)),O=d(h(r==1?u.max:u.min,u,p,x)),g=new Path2D(s);return b(g,P,O),b(g,A,O),b(g,A,y),g})}function Qa(i,t,e,n,s,r){let o=null;if(i.length>0){o=new Path2D;const a=t==0?nl:jh;let l=e;for(let f=0;f<i.length;f++){let h=i[f];if(h[1]>h[0]){let _=h[0]-l;_>0&&a(o,l,n,_,n+r),l=h[1]}}let c=e+s-l,u=10;c>0&&a(o,l,n-u/2,c,n+r+u)}return o}function EE(i,t,e){let n=i[i.length-1];n&&n[0]==t?n[1]=e:i.push([t,e])}function Yh(i,t,e,n,s,r,o){let a=[],l=i.length;for(let c=s==1?e:n;c>=e&&c<=n;c+=s)if(t[c]===null){let f=c,h=c;if(s==1)for(;++c<=n&&t[c]===null;)h=c;else for(;--c>=e&&t[c]===null;)h=c;let _=r(i[f]),x=h==f?_:r(i[h]),M=f-s;_=o<=0&&M>=0&&M<l?r(i[M]):_;let d=h+s;x=o>=0&&d>=0&&d<l?r(i[d]):x,x>=_&&a.push([_,x])}return a}function dd(i){return i==0?Ep:i==1?tn:t=>ws(t,i)}function Yp(i){let t=i==0?tl:el,e=i==0?(s,r,o,a,l,c)=>{s.arcTo(r,o,a,l,c)}:(s,r,o,a,l,c)=>{s.arcTo(o,r,l,a,c)},n=i==0?(s,r,o,a,l)=>{s.rect(r,o,a,l)}:(s,r,o,a,l)=>{s.rect(o,r,l,a)};return(s,r,o,a,l,c=0,u=0)=>{c==0&&u==0?n(s,r,o,a,l):(c=Jn(c,a/2,l/2),u=Jn(u,a/2,l/2),t(s,r+c,o),e(s,r+a,o,r+a,o+l,c),e(s,r+a,o+l,r,o+l,u),e(s,r,o+l,r,o,u),e(s,r,o,r+a,o,c),s.closePath())}}const tl=(i,t,e)=>{i.moveTo(t,e)},el=(i,t,e)=>{i.moveTo(e,t)},Vr=(i,t,e)=>{i.lineTo(t,e)},Wr=(i,t,e)=>{i.lineTo(e,t)},nl=Yp(0),jh=Yp(1),jp=(i,t,e,n,s,r)=>{i.arc(t,e,n,s,r)},Kp=(i,t,e,n,s,r)=>{i.arc(e,t,n,s,r)},$p=(i,t,e,n,s,r,o)=>{i.bezierCurveTo(t,e,n,s,r,o)},Zp=(i,t,e,n,s,r,o)=>{i.bezierCurveTo(e,t,s,n,o,r)};function Jp(i){return(t,e,n,s,r)=>zs(t,e,(o,a,l,c,u,f,h,_,x,M,p)=>{let{pxRound:d,points:C}=o,b,R;c.ori==0?(b=tl,R=jp):(b=el,R=Kp);const D=Pe(C.width*xe,3);let A=(C.size-C.width)/2*xe,y=Pe(A*2,3),P=new Path2D,O=new Path2D,{left:g,top:m,width:E,height:N}=t.bbox;nl(O,g-y,m-y,E+y*2,N+y*2);const F=B=>{if(l[B]!=null){let G=d(f(a[B],c,M,_)),K=d(h(l[B],u,p,x));b(P,G+A,K),R(P,G,K,A,0,Ta*2)}};if(r)r.forEach(F);else for(let B=n;B<=s;B++)F(B);return{stroke:D>0?P:null,fill:P,clip:O,flags:Or|ch}})}function Qp(i){return(t,e,n,s,r,o)=>{n!=s&&(r!=n&&o!=n&&i(t,e,n),r!=s&&o!=s&&i(t,e,s),i(t,e,o))}}const wE=Qp(Vr),bE=Qp(Wr);function tm(i){const t=ve(i?.alignGaps,0);return(e,n,s,r)=>zs(e,n,(o,a,l,c,u,f,h,_,x,M,p)=>{let d=o.pxRound,C=xt=>d(f(xt,c,M,_)),b=xt=>d(h(xt,u,p,x)),R,D;c.ori==0?(R=Vr,D=wE):(R=Wr,D=bE);const A=c.dir*(c.ori==0?1:-1),y={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:Or},P=y.stroke;let O=ue,g=-ue,m,E,N,F=C(a[A==1?s:r]),B=Ir(l,s,r,1*A),G=Ir(l,s,r,-1*A),K=C(a[B]),Q=C(a[G]),dt=!1;for(let xt=A==1?s:r;xt>=s&&xt<=r;xt+=A){let Vt=C(a[xt]),rt=l[xt];Vt==F?rt!=null?(E=b(rt),O==ue&&(R(P,Vt,E),m=E),O=Jn(E,O),g=Mn(E,g)):rt===null&&(dt=!0):(O!=ue&&(D(P,F,O,g,m,E),N=F),rt!=null?(E=b(rt),R(P,Vt,E),O=g=m=E):(O=ue,g=-ue,rt===null&&(dt=!0)),F=Vt)}O!=ue&&O!=g&&N!=F&&D(P,F,O,g,m,E);let[ct,gt]=qh(e,n);if(o.fill!=null||ct!=0){let xt=y.fill=new Path2D(P),Vt=o.fillTo(e,n,o.min,o.max,ct),rt=b(Vt);R(xt,Q,rt),R(xt,K,rt)}if(!o.spanGaps){let xt=[];dt&&xt.push(...Yh(a,l,s,r,A,C,t)),y.gaps=xt=o.gaps(e,n,s,r,xt),y.clip=Qa(xt,c.ori,_,x,M,p)}return gt!=0&&(y.band=gt==2?[zi(e,n,s,r,P,-1),zi(e,n,s,r,P,1)]:zi(e,n,s,r,P,gt)),y})}function TE(i){const t=ve(i.align,1),e=ve(i.ascDesc,!1),n=ve(i.alignGaps,0),s=ve(i.extend,!1);return(r,o,a,l)=>zs(r,o,(c,u,f,h,_,x,M,p,d,C,b)=>{let R=c.pxRound,{left:D,width:A}=r.bbox,y=ct=>R(x(ct,h,C,p)),P=ct=>R(M(ct,_,b,d)),O=h.ori==0?Vr:Wr;const g={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:Or},m=g.stroke,E=h.dir*(h.ori==0?1:-1);a=Ir(f,a,l,1),l=Ir(f,a,l,-1);let N=P(f[E==1?a:l]),F=y(u[E==1?a:l]),B=F,G=F;s&&t==-1&&(G=D,O(m,G,N)),O(m,F,N);for(let ct=E==1?a:l;ct>=a&&ct<=l;ct+=E){let gt=f[ct];if(gt==null)continue;let xt=y(u[ct]),Vt=P(gt);t==1?O(m,xt,N):O(m,B,Vt),O(m,xt,Vt),N=Vt,B=xt}let K=B;s&&t==1&&(K=D+A,O(m,K,N));let[Q,dt]=qh(r,o);if(c.fill!=null||Q!=0){let ct=g.fill=new Path2D(m),gt=c.fillTo(r,o,c.min,c.max,Q),xt=P(gt);O(ct,K,xt),O(ct,G,xt)}if(!c.spanGaps){let ct=[];ct.push(...Yh(u,f,a,l,E,y,n));let gt=c.width*xe/2,xt=e||t==1?gt:-gt,Vt=e||t==-1?-gt:gt;ct.forEach(rt=>{rt[0]+=xt,rt[1]+=Vt}),g.gaps=ct=c.gaps(r,o,a,l,ct),g.clip=Qa(ct,h.ori,p,d,C,b)}return dt!=0&&(g.band=dt==2?[zi(r,o,a,l,m,-1),zi(r,o,a,l,m,1)]:zi(r,o,a,l,m,dt)),g})}function pd(i,t,e,n,s,r,o=ue){if(i.length>1){let a=null;for(let l=0,c=1/0;l<i.length;l++)if(t[l]!==void 0){if(a!=null){let u=nn(i[l]-i[a]);u<c&&(c=u,o=nn(e(i[l],n,s,r)-e(i[a],n,s,r)))}a=l}}return o}function AE(i){i=i||_o;const t=ve(i.size,[.6,ue,1]),e=i.align||0,n=i.gap||0;let s=i.radius;s=s==null?[0,0]:typeof s=="number"?[s,0]:s;const r=he(s),o=1-t[0],a=ve(t[1],ue),l=ve(t[2],1),c=ve(i.disp,_o),u=ve(i.each,_=>{}),{fill:f,stroke:h}=c;return(_,x,M,p)=>zs(_,x,(d,C,b,R,D,A,y,P,O,g,m)=>{let E=d.pxRound,N=e,F=n*xe,B=a*xe,G=l*xe,K,Q;R.ori==0?[K,Q]=r(_,x):[Q,K]=r(_,x);const dt=R.dir*(R.ori==0?1:-1);let ct=R.ori==0?nl:jh,gt=R.ori==0?u:(nt,It,wt,Ut,re,mt,Rt)=>{u(nt,It,wt,re,Ut,Rt,mt)},xt=ve(_.bands,Hh).find(nt=>nt.series[0]==x),Vt=xt!=null?xt.dir:0,rt=d.fillTo(_,x,d.min,d.max,Vt),pt=E(y(rt,D,m,O)),Dt,St,Z,J=g,Y=E(d.width*xe),ot=!1,at=null,I=null,Ot=null,Mt=null;f!=null&&(Y==0||h!=null)&&(ot=!0,at=f.values(_,x,M,p),I=new Map,new Set(at).forEach(nt=>{nt!=null&&I.set(nt,new Path2D)}),Y>0&&(Ot=h.values(_,x,M,p),Mt=new Map,new Set(Ot).forEach(nt=>{nt!=null&&Mt.set(nt,new Path2D)})));let{x0:Ht,size:At}=c;if(Ht!=null&&At!=null){N=1,C=Ht.values(_,x,M,p),Ht.unit==2&&(C=C.map(wt=>_.posToVal(P+wt*g,R.key,!0)));let nt=At.values(_,x,M,p);At.unit==2?St=nt[0]*g:St=A(nt[0],R,g,P)-A(0,R,g,P),J=pd(C,b,A,R,g,P,J),Z=J-St+F}else J=pd(C,b,A,R,g,P,J),Z=J*o+F,St=J-Z;Z<1&&(Z=0),Y>=St/2&&(Y=0),Z<5&&(E=Ep);let Et=Z>0,Xt=J-Z-(Et?Y:0);St=E(oh(Xt,G,B)),Dt=(N==0?St/2:N==dt?0:St)-N*dt*((N==0?F/2:0)+(Et?Y/2:0));const L={stroke:null,fill:null,clip:null,band:null,gaps:null,flags:0},w=ot?null:new Path2D;let V=null;if(xt!=null)V=_.data[xt.series[1]];else{let{y0:nt,y1:It}=c;nt!=null&&It!=null&&(b=It.values(_,x,M,p),V=nt.values(_,x,M,p))}let it=K*St,ht=Q*St;for(let nt=dt==1?M:p;nt>=M&&nt<=p;nt+=dt){let It=b[nt];if(It==null)continue;if(V!=null){let Lt=V[nt]??0;if(It-Lt==0)continue;pt=y(Lt,D,m,O)}let wt=R.distr!=2||c!=null?C[nt]:nt,Ut=A(wt,R,g,P),re=y(ve(It,rt),D,m,O),mt=E(Ut-Dt),Rt=E(Mn(re,pt)),jt=E(Jn(re,pt)),$t=Rt-jt;if(It!=null){let Lt=It<0?ht:it,ne=It<0?it:ht;ot?(Y>0&&Ot[nt]!=null&&ct(Mt.get(Ot[nt]),mt,jt+Gn(Y/2),St,Mn(0,$t-Y),Lt,ne),at[nt]!=null&&ct(I.get(at[nt]),mt,jt+Gn(Y/2),St,Mn(0,$t-Y),Lt,ne)):ct(w,mt,jt+Gn(Y/2),St,Mn(0,$t-Y),Lt,ne),gt(_,x,nt,mt-Y/2,jt,St+Y,$t)}}return Y>0?L.stroke=ot?Mt:w:ot||(L._fill=d.width==0?d._fill:d._stroke??d._fill,L.width=0),L.fill=ot?I:w,L})}function RE(i,t){const e=ve(t?.alignGaps,0);return(n,s,r,o)=>zs(n,s,(a,l,c,u,f,h,_,x,M,p,d)=>{let C=a.pxRound,b=K=>C(h(K,u,p,x)),R=K=>C(_(K,f,d,M)),D,A,y;u.ori==0?(D=tl,y=Vr,A=$p):(D=el,y=Wr,A=Zp);const P=u.dir*(u.ori==0?1:-1);r=Ir(c,r,o,1),o=Ir(c,r,o,-1);let O=b(l[P==1?r:o]),g=O,m=[],E=[];for(let K=P==1?r:o;K>=r&&K<=o;K+=P)if(c[K]!=null){let dt=l[K],ct=b(dt);m.push(g=ct),E.push(R(c[K]))}const N={stroke:i(m,E,D,y,A,C),fill:null,clip:null,band:null,gaps:null,flags:Or},F=N.stroke;let[B,G]=qh(n,s);if(a.fill!=null||B!=0){let K=N.fill=new Path2D(F),Q=a.fillTo(n,s,a.min,a.max,B),dt=R(Q);y(K,g,dt),y(K,O,dt)}if(!a.spanGaps){let K=[];K.push(...Yh(l,c,r,o,P,b,e)),N.gaps=K=a.gaps(n,s,r,o,K),N.clip=Qa(K,u.ori,x,M,p,d)}return G!=0&&(N.band=G==2?[zi(n,s,r,o,F,-1),zi(n,s,r,o,F,1)]:zi(n,s,r,o,F,G)),N})}function CE(i){return RE(PE,i)}function PE(i,t,e,n,s,r){const o=i.length;if(o<2)return null;const a=new Path2D;if(e(a,i[0],t[0]),o==2)n(a,i[1],t[1]);else{let l=Array(o),c=Array(o-1),u=Array(o-1),f=Array(o-1);for(let h=0;h<o-1;h++)u[h]=t[h+1]-t[h],f[h]=i[h+1]-i[h],c[h]=u[h]/f[h];l[0]=c[0];for(let h=1;h<o-1;h++)c[h]===0||c[h-1]===0||c[h-1]>0!=c[h]>0?l[h]=0:(l[h]=3*(f[h-1]+f[h])/((2*f[h]+f[h-1])/c[h-1]+(f[h]+2*f[h-1])/c[h]),isFinite(l[h])||(l[h]=0));l[o-1]=c[o-2];for(let h=0;h<o-1;h++)s(a,i[h]+f[h]/3,t[h]+l[h]*f[h]/3,i[h+1]-f[h]/3,t[h+1]-l[h+1]*f[h]/3,i[h+1],t[h+1])}return a}const hh=new Set;function md(){for(let i of hh)i.syncRect(!0)}Gr&&(Is(hS,Tr,md),Is(uS,Tr,md,!0),Is(Fa,Tr,()=>{yn.pxRatio=xe}));const LE=tm(),DE=Jp();function gd(i,t,e,n){return(n?[i[0],i[1]].concat(i.slice(2)):[i[0]].concat(i.slice(1))).map((r,o)=>uh(r,o,t,e))}function IE(i,t){return i.map((e,n)=>n==0?{}:Je({},t,e))}function uh(i,t,e,n){return Je({},t==0?e:n,i)}function em(i,t,e){return t==null?Nr:[t,e]}const UE=em;function NE(i,t,e){return t==null?Nr:Ba(t,e,Bh,!0)}function nm(i,t,e,n){return t==null?Nr:$a(t,e,i.scales[n].log,!1)}const kE=nm;function im(i,t,e,n){return t==null?Nr:Fh(t,e,i.scales[n].log,!1)}const OE=im;function FE(i,t,e,n,s){let r=Mn(jf(i),jf(t)),o=t-i,a=ci(s/n*o,e);do{let l=e[a],c=n*l/o;if(c>=s&&r+(l<5?us.get(l):0)<=17)return[l,c]}while(++a<e.length);return[0,0]}function _d(i){let t,e;return i=i.replace(/(\d+)px/,(n,s)=>(t=tn((e=+s)*xe))+"px"),[i,t,e]}function BE(i){i.show&&[i.font,i.labelFont].forEach(t=>{let e=Pe(t[2]*xe,1);t[0]=t[0].replace(/[0-9.]+px/,e+"px"),t[1]=e})}function yn(i,t,e){const n={mode:ve(i.mode,1)},s=n.mode;function r(v,S){return((S.distr==3?Bi(v>0?v:S.clamp(n,v,S.min,S.max,S.key)):S.distr==4?tc(v,S.asinh):S.distr==100?S.fwd(v):v)-S._min)/(S._max-S._min)}function o(v,S,U,k){let X=r(v,S);return k+U*(S.dir==-1?1-X:X)}function a(v,S,U,k){let X=r(v,S);return k+U*(S.dir==-1?X:1-X)}function l(v,S,U,k){return S.ori==0?o(v,S,U,k):a(v,S,U,k)}n.valToPosH=o,n.valToPosV=a;let c=!1;n.status=0;const u=n.root=jn(qy);if(i.id!=null&&(u.id=i.id),zn(u,i.class),i.title){let v=jn(Ky,u);v.textContent=i.title}const f=li("canvas"),h=n.ctx=f.getContext("2d"),_=jn($y,u);Is("click",_,v=>{v.target===M&&(Ie!=js||ze!=Ks)&&pn.click(n,v)},!0);const x=n.under=jn(Zy,_);_.appendChild(f);const M=n.over=jn(Jy,_);i=kr(i);const p=+ve(i.pxAlign,1),d=dd(p);(i.plugins||[]).forEach(v=>{v.opts&&(i=v.opts(n,i)||i)});const C=i.ms||.001,b=n.series=s==1?gd(i.series||[],od,ud,!1):IE(i.series||[null],hd),R=n.axes=gd(i.axes||[],rd,ld,!0),D=n.scales={},A=n.bands=i.bands||[];A.forEach(v=>{v.fill=he(v.fill||null),v.dir=ve(v.dir,-1)});const y=s==2?b[1].facets[0].scale:b[0].scale,P={axes:_m,series:mi},O=(i.drawOrder||["axes","series"]).map(v=>P[v]);function g(v){let S=D[v];if(S==null){let U=(i.scales||_o)[v]||_o;if(U.from!=null)g(U.from),D[v]=Je({},D[U.from],U,{key:v});else{S=D[v]=Je({},v==y?Xp:yE,U),S.key=v;let k=S.time,X=S.range,st=ts(X);if((v!=y||s==2&&!k)&&(st&&(X[0]==null||X[1]==null)&&(X={min:X[0]==null?Xf:{mode:1,hard:X[0],soft:X[0]},max:X[1]==null?Xf:{mode:1,hard:X[1],soft:X[1]}},st=!1),!st&&Ja(X))){let ut=X;X=(_t,yt,kt)=>yt==null?Nr:Ba(yt,kt,ut)}S.range=he(X||(k?UE:v==y?S.distr==3?kE:S.distr==4?OE:em:S.distr==3?nm:S.distr==4?im:NE)),S.auto=he(st?!1:S.auto),S.clamp=he(S.clamp||ME),S._min=S._max=null}}}g("x"),g("y"),s==1&&b.forEach(v=>{g(v.scale)}),R.forEach(v=>{g(v.scale)});for(let v in i.scales)g(v);const m=D[y],E=m.distr;let N,F;m.ori==0?(zn(u,Yy),N=o,F=a):(zn(u,jy),N=a,F=o);const B={};for(let v in D){let S=D[v];(S.min!=null||S.max!=null)&&(B[v]={min:S.min,max:S.max},S.min=S.max=null)}const G=i.tzDate||(v=>new Date(tn(v/C))),K=i.fmtDate||Gh,Q=C==1?YS(G):$S(G),dt=nd(G,ed(C==1?qS:KS,K)),ct=sd(G,id(JS,K)),gt=[],xt=n.legend=Je({},eE,i.legend),Vt=xt.show,rt=xt.markers;xt.idxs=gt,rt.width=he(rt.width),rt.dash=he(rt.dash),rt.stroke=he(rt.stroke),rt.fill=he(rt.fill);let pt,Dt,St,Z=[],J=[],Y,ot=!1,at={};if(xt.live){const v=b[1]?b[1].values:null;ot=v!=null,Y=ot?v(n,1,0):{_:0};for(let S in Y)at[S]=kh}if(Vt)if(pt=li("table",sS,u),St=li("tbody",null,pt),xt.mount(n,pt),ot){Dt=li("thead",null,pt,St);let v=li("tr",null,Dt);li("th",null,v);for(var I in Y)li("th",Lf,v).textContent=I}else zn(pt,oS),xt.live&&zn(pt,rS);const Ot={show:!0},Mt={show:!1};function Ht(v,S){if(S==0&&(ot||!xt.live||s==2))return Nr;let U=[],k=li("tr",aS,St,St.childNodes[S]);zn(k,v.class),v.show||zn(k,Rs);let X=li("th",null,k);if(rt.show){let _t=jn(lS,X);if(S>0){let yt=rt.width(n,S);yt&&(_t.style.border=yt+"px "+rt.dash(n,S)+" "+rt.stroke(n,S)),_t.style.background=rt.fill(n,S)}}let st=jn(Lf,X);st.textContent=v.label,S>0&&(rt.show||(st.style.color=v.width>0?rt.stroke(n,S):rt.fill(n,S)),Et("click",X,_t=>{if(bt._lock)return;We(_t);let yt=b.indexOf(v);if((_t.ctrlKey||_t.metaKey)!=xt.isolate){let kt=b.some((Ft,zt)=>zt>0&&zt!=yt&&Ft.show);b.forEach((Ft,zt)=>{zt>0&&gi(zt,kt?zt==yt?Ot:Mt:Ot,!0,Ke.setSeries)})}else gi(yt,{show:!v.show},!0,Ke.setSeries)},!1),Ti&&Et(kf,X,_t=>{bt._lock||(We(_t),gi(b.indexOf(v),Zs,!0,Ke.setSeries))},!1));for(var ut in Y){let _t=li("td",cS,k);_t.textContent="--",U.push(_t)}return[k,U]}const At=new Map;function Et(v,S,U,k=!0){const X=At.get(S)||{},st=bt.bind[v](n,S,U,k);st&&(Is(v,S,X[v]=st),At.set(S,X))}function Xt(v,S,U){const k=At.get(S)||{};for(let X in k)(v==null||X==v)&&(rh(X,S,k[X]),delete k[X]);v==null&&At.delete(S)}let L=0,w=0,V=0,it=0,ht=0,nt=0,It=ht,wt=nt,Ut=V,re=it,mt=0,Rt=0,jt=0,$t=0;n.bbox={};let Lt=!1,ne=!1,Qt=!1,pe=!1,q=!1,Tt=!1;function lt(v,S,U){(U||v!=n.width||S!=n.height)&&ft(v,S),Ws(!1),Qt=!0,ne=!0,Xs()}function ft(v,S){n.width=L=V=v,n.height=w=it=S,ht=nt=0,Ve(),mn();let U=n.bbox;mt=U.left=ws(ht*xe,.5),Rt=U.top=ws(nt*xe,.5),jt=U.width=ws(V*xe,.5),$t=U.height=ws(it*xe,.5)}const Nt=3;function Bt(){let v=!1,S=0;for(;!v;){S++;let U=mm(S),k=gm(S);v=S==Nt||U&&k,v||(ft(n.width,n.height),ne=!0)}}function fe({width:v,height:S}){lt(v,S)}n.setSize=fe;function Ve(){let v=!1,S=!1,U=!1,k=!1;R.forEach((X,st)=>{if(X.show&&X._show){let{side:ut,_size:_t}=X,yt=ut%2,kt=X.label!=null?X.labelSize:0,Ft=_t+kt;Ft>0&&(yt?(V-=Ft,ut==3?(ht+=Ft,k=!0):U=!0):(it-=Ft,ut==0?(nt+=Ft,v=!0):S=!0))}}),di[0]=v,di[1]=U,di[2]=S,di[3]=k,V-=T[1]+T[3],ht+=T[3],it-=T[2]+T[0],nt+=T[0]}function mn(){let v=ht+V,S=nt+it,U=ht,k=nt;function X(st,ut){switch(st){case 1:return v+=ut,v-ut;case 2:return S+=ut,S-ut;case 3:return U-=ut,U+ut;case 0:return k-=ut,k+ut}}R.forEach((st,ut)=>{if(st.show&&st._show){let _t=st.side;st._pos=X(_t,st._size),st.label!=null&&(st._lpos=X(_t,st.labelSize))}})}const bt=n.cursor=Je({},aE,{drag:{y:s==2}},i.cursor);if(bt.dataIdx==null){let v=bt.hover,S=v.skip=new Set(v.skip??[]);S.add(void 0);let U=v.prox=he(v.prox),k=v.bias??=0;bt.dataIdx=(X,st,ut,_t)=>{if(st==0)return ut;let yt=ut,kt=U(X,st,ut,_t)??ue,Ft=kt>=0&&kt<ue,zt=m.ori==0?V:it,te=bt.left,Re=t[0],de=t[st];if(S.has(de[ut])){yt=null;let ce=null,ie=null,Yt;if(k==0||k==-1)for(Yt=ut;ce==null&&Yt-- >0;)S.has(de[Yt])||(ce=Yt);if(k==0||k==1)for(Yt=ut;ie==null&&Yt++<de.length;)S.has(de[Yt])||(ie=Yt);if(ce!=null||ie!=null)if(Ft){let we=ce==null?-1/0:N(Re[ce],m,zt,0),je=ie==null?1/0:N(Re[ie],m,zt,0),Xe=te-we,Ne=je-te;Xe<=Ne?Xe<=kt&&(yt=ce):Ne<=kt&&(yt=ie)}else yt=ie==null?ce:ce==null?ie:ut-ce<=ie-ut?ce:ie}else Ft&&nn(te-N(Re[ut],m,zt,0))>kt&&(yt=null);return yt}}const We=v=>{bt.event=v};bt.idxs=gt,bt._lock=!1;let Le=bt.points;Le.show=he(Le.show),Le.size=he(Le.size),Le.stroke=he(Le.stroke),Le.width=he(Le.width),Le.fill=he(Le.fill);const ni=n.focus=Je({},i.focus||{alpha:.3},bt.focus),Ti=ni.prox>=0,Cn=Ti&&Le.one;let gn=[],Ai=[],Ri=[];function ds(v,S){let U=Le.show(n,S);if(U)return zn(U,iS),zn(U,v.class),xi(U,-10,-10,V,it),M.insertBefore(U,gn[S]),U}function Xr(v,S){if(s==1||S>0){let U=s==1&&D[v.scale].time,k=v.value;v.value=U?Zf(k)?sd(G,id(k,K)):k||ct:k||_E,v.label=v.label||(U?cE:lE)}if(Cn||S>0){v.width=v.width==null?1:v.width,v.paths=v.paths||LE||yS,v.fillTo=he(v.fillTo||SE),v.pxAlign=+ve(v.pxAlign,p),v.pxRound=dd(v.pxAlign),v.stroke=he(v.stroke||null),v.fill=he(v.fill||null),v._stroke=v._fill=v._paths=v._focus=null;let U=vE(Mn(1,v.width),1),k=v.points=Je({},{size:U,width:Mn(1,U*.2),stroke:v.stroke,space:U*2,paths:DE,_stroke:null,_fill:null},v.points);k.show=he(k.show),k.filter=he(k.filter),k.fill=he(k.fill),k.stroke=he(k.stroke),k.paths=he(k.paths),k.pxAlign=v.pxAlign}if(Vt){let U=Ht(v,S);Z.splice(S,0,U[0]),J.splice(S,0,U[1]),xt.values.push(null)}if(bt.show){gt.splice(S,0,null);let U=null;Cn?S==0&&(U=ds(v,S)):S>0&&(U=ds(v,S)),gn.splice(S,0,U),Ai.splice(S,0,0),Ri.splice(S,0,0)}hn("addSeries",S)}function Hs(v,S){S=S??b.length,v=s==1?uh(v,S,od,ud):uh(v,S,{},hd),b.splice(S,0,v),Xr(b[S],S)}n.addSeries=Hs;function Ro(v){if(b.splice(v,1),Vt){xt.values.splice(v,1),J.splice(v,1);let S=Z.splice(v,1)[0];Xt(null,S.firstChild),S.remove()}bt.show&&(gt.splice(v,1),gn.splice(v,1)[0].remove(),Ai.splice(v,1),Ri.splice(v,1)),hn("delSeries",v)}n.delSeries=Ro;const di=[!1,!1,!1,!1];function il(v,S){if(v._show=v.show,v.show){let U=v.side%2,k=D[v.scale];k==null&&(v.scale=U?b[1].scale:y,k=D[v.scale]);let X=k.time;v.size=he(v.size),v.space=he(v.space),v.rotate=he(v.rotate),ts(v.incrs)&&v.incrs.forEach(ut=>{!us.has(ut)&&us.set(ut,Tp(ut))}),v.incrs=he(v.incrs||(k.distr==2?VS:X?C==1?XS:jS:bs)),v.splits=he(v.splits||(X&&k.distr==1?Q:k.distr==3?ah:k.distr==4?fE:uE)),v.stroke=he(v.stroke),v.grid.stroke=he(v.grid.stroke),v.ticks.stroke=he(v.ticks.stroke),v.border.stroke=he(v.border.stroke);let st=v.values;v.values=ts(st)&&!ts(st[0])?he(st):X?ts(st)?nd(G,ed(st,K)):Zf(st)?ZS(G,st):st||dt:st||hE,v.filter=he(v.filter||(k.distr>=3&&k.log==10?mE:k.distr==3&&k.log==2?gE:wp)),v.font=_d(v.font),v.labelFont=_d(v.labelFont),v._size=v.size(n,null,S,0),v._space=v._rotate=v._incrs=v._found=v._splits=v._values=null,v._size>0&&(di[S]=!0,v._el=jn(Qy,_))}}function ps(v,S,U,k){let[X,st,ut,_t]=U,yt=S%2,kt=0;return yt==0&&(_t||st)&&(kt=S==0&&!X||S==2&&!ut?tn(rd.size/3):0),yt==1&&(X||ut)&&(kt=S==1&&!st||S==3&&!_t?tn(ld.size/2):0),kt}const Co=n.padding=(i.padding||[ps,ps,ps,ps]).map(v=>he(ve(v,ps))),T=n._padding=Co.map((v,S)=>v(n,S,di,0));let W,tt=null,et=null;const j=s==1?b[0].idxs:null;let vt=null,Ct=!1;function Gt(v,S){if(t=v??[],n.data=n._data=t,s==2){W=0;for(let U=1;U<b.length;U++)W+=t[U][0].length}else{t.length==0&&(n.data=n._data=t=[[]]),vt=t[0],W=vt.length;let U=t;if(E==2){U=t.slice();let k=U[0]=Array(W);for(let X=0;X<W;X++)k[X]=X}n._data=t=U}if(Ws(!0),hn("setData"),E==2&&(Qt=!0),S!==!1){let U=m;U.auto(n,Ct)?Wt():Vi(y,U.min,U.max),pe=pe||bt.left>=0,Tt=!0,Xs()}}n.setData=Gt;function Wt(){Ct=!0;let v,S;s==1&&(W>0?(tt=j[0]=0,et=j[1]=W-1,v=t[0][tt],S=t[0][et],E==2?(v=tt,S=et):v==S&&(E==3?[v,S]=$a(v,v,m.log,!1):E==4?[v,S]=Fh(v,v,m.log,!1):m.time?S=v+tn(86400/C):[v,S]=Ba(v,S,Bh,!0))):(tt=j[0]=v=null,et=j[1]=S=null)),Vi(y,v,S)}let Jt,Zt,qt,ge,Ee,De,dn,me,Kt,Ae;function _e(v,S,U,k,X,st){v??=If,U??=Hh,k??="butt",X??=If,st??="round",v!=Jt&&(h.strokeStyle=Jt=v),X!=Zt&&(h.fillStyle=Zt=X),S!=qt&&(h.lineWidth=qt=S),st!=Ee&&(h.lineJoin=Ee=st),k!=De&&(h.lineCap=De=k),U!=ge&&h.setLineDash(ge=U)}function Pn(v,S,U,k){S!=Zt&&(h.fillStyle=Zt=S),v!=dn&&(h.font=dn=v),U!=me&&(h.textAlign=me=U),k!=Kt&&(h.textBaseline=Kt=k)}function pi(v,S,U,k,X=0){if(k.length>0&&v.auto(n,Ct)&&(S==null||S.min==null)){let st=ve(tt,0),ut=ve(et,k.length-1),_t=U.min==null?v.distr==3?mS(k,st,ut):pS(k,st,ut,X):[U.min,U.max];v.min=Jn(v.min,U.min=_t[0]),v.max=Mn(v.max,U.max=_t[1])}}const _n={min:null,max:null};function qr(){for(let k in D){let X=D[k];B[k]==null&&(X.min==null||B[y]!=null&&X.auto(n,Ct))&&(B[k]=_n)}for(let k in D){let X=D[k];B[k]==null&&X.from!=null&&B[X.from]!=null&&(B[k]=_n)}B[y]!=null&&Ws(!0);let v={};for(let k in B){let X=B[k];if(X!=null){let st=v[k]=kr(D[k],wS);if(X.min!=null)Je(st,X);else if(k!=y||s==2)if(W==0&&st.from==null){let ut=st.range(n,null,null,k);st.min=ut[0],st.max=ut[1]}else st.min=ue,st.max=-ue}}if(W>0){b.forEach((k,X)=>{if(s==1){let st=k.scale,ut=B[st];if(ut==null)return;let _t=v[st];if(X==0){let yt=_t.range(n,_t.min,_t.max,st);_t.min=yt[0],_t.max=yt[1],tt=ci(_t.min,t[0]),et=ci(_t.max,t[0]),et-tt>1&&(t[0][tt]<_t.min&&tt++,t[0][et]>_t.max&&et--),k.min=vt[tt],k.max=vt[et]}else k.show&&k.auto&&pi(_t,ut,k,t[X],k.sorted);k.idxs[0]=tt,k.idxs[1]=et}else if(X>0&&k.show&&k.auto){let[st,ut]=k.facets,_t=st.scale,yt=ut.scale,[kt,Ft]=t[X],zt=v[_t],te=v[yt];zt!=null&&pi(zt,B[_t],st,kt,st.sorted),te!=null&&pi(te,B[yt],ut,Ft,ut.sorted),k.min=ut.min,k.max=ut.max}});for(let k in v){let X=v[k],st=B[k];if(X.from==null&&(st==null||st.min==null)){let ut=X.range(n,X.min==ue?null:X.min,X.max==-ue?null:X.max,k);X.min=ut[0],X.max=ut[1]}}}for(let k in v){let X=v[k];if(X.from!=null){let st=v[X.from];if(st.min==null)X.min=X.max=null;else{let ut=X.range(n,st.min,st.max,k);X.min=ut[0],X.max=ut[1]}}}let S={},U=!1;for(let k in v){let X=v[k],st=D[k];if(st.min!=X.min||st.max!=X.max){st.min=X.min,st.max=X.max;let ut=st.distr;st._min=ut==3?Bi(st.min):ut==4?tc(st.min,st.asinh):ut==100?st.fwd(st.min):st.min,st._max=ut==3?Bi(st.max):ut==4?tc(st.max,st.asinh):ut==100?st.fwd(st.max):st.max,S[k]=U=!0}}if(U){b.forEach((k,X)=>{s==2?X>0&&S.y&&(k._paths=null):S[k.scale]&&(k._paths=null)});for(let k in S)Qt=!0,hn("setScale",k);bt.show&&bt.left>=0&&(pe=Tt=!0)}for(let k in B)B[k]=null}function He(v){let S=oh(tt-1,0,W-1),U=oh(et+1,0,W-1);for(;v[S]==null&&S>0;)S--;for(;v[U]==null&&U<W-1;)U++;return[S,U]}function mi(){W>0&&(b.forEach((v,S)=>{if(S>0&&v.show&&(Gs(S,!1),Gs(S,!0),v._paths==null)){Ae!=v.alpha&&(h.globalAlpha=Ae=v.alpha);let U=s==2?[0,t[S][0].length-1]:He(t[S]);v._paths=v.paths(n,S,U[0],U[1]),Ae!=1&&(h.globalAlpha=Ae=1)}}),b.forEach((v,S)=>{if(S>0&&v.show){Ae!=v.alpha&&(h.globalAlpha=Ae=v.alpha),v._paths!=null&&En(S,!1);{let U=v._paths!=null?v._paths.gaps:null,k=v.points.show(n,S,tt,et,U),X=v.points.filter(n,S,k,U);(k||X)&&(v.points._paths=v.points.paths(n,S,tt,et,X),En(S,!0))}Ae!=1&&(h.globalAlpha=Ae=1),hn("drawSeries",S)}}))}function Gs(v,S){let U=S?b[v].points:b[v];U._stroke=U.stroke(n,v),U._fill=U.fill(n,v)}function En(v,S){let U=S?b[v].points:b[v],{stroke:k,fill:X,clip:st,flags:ut,_stroke:_t=U._stroke,_fill:yt=U._fill,_width:kt=U.width}=U._paths;kt=Pe(kt*xe,3);let Ft=null,zt=kt%2/2;S&&yt==null&&(yt=kt>0?"#fff":_t);let te=U.pxAlign==1&&zt>0;if(te&&h.translate(zt,zt),!S){let Re=mt-kt/2,de=Rt-kt/2,ce=jt+kt,ie=$t+kt;Ft=new Path2D,Ft.rect(Re,de,ce,ie)}S?Vs(_t,kt,U.dash,U.cap,yt,k,X,ut,st):Yr(v,_t,kt,U.dash,U.cap,yt,k,X,ut,Ft,st),te&&h.translate(-zt,-zt)}function Yr(v,S,U,k,X,st,ut,_t,yt,kt,Ft){let zt=!1;yt!=0&&A.forEach((te,Re)=>{if(te.series[0]==v){let de=b[te.series[1]],ce=t[te.series[1]],ie=(de._paths||_o).band;ts(ie)&&(ie=te.dir==1?ie[0]:ie[1]);let Yt,we=null;de.show&&ie&&_S(ce,tt,et)?(we=te.fill(n,Re)||st,Yt=de._paths.clip):ie=null,Vs(S,U,k,X,we,ut,_t,yt,kt,Ft,Yt,ie),zt=!0}}),zt||Vs(S,U,k,X,st,ut,_t,yt,kt,Ft)}const Po=Or|ch;function Vs(v,S,U,k,X,st,ut,_t,yt,kt,Ft,zt){_e(v,S,U,k,X),(yt||kt||zt)&&(h.save(),yt&&h.clip(yt),kt&&h.clip(kt)),zt?(_t&Po)==Po?(h.clip(zt),Ft&&h.clip(Ft),Do(X,ut),Lo(v,st,S)):_t&ch?(Do(X,ut),h.clip(zt),Lo(v,st,S)):_t&Or&&(h.save(),h.clip(zt),Ft&&h.clip(Ft),Do(X,ut),h.restore(),Lo(v,st,S)):(Do(X,ut),Lo(v,st,S)),(yt||kt||zt)&&h.restore()}function Lo(v,S,U){U>0&&(S instanceof Map?S.forEach((k,X)=>{h.strokeStyle=Jt=X,h.stroke(k)}):S!=null&&v&&h.stroke(S))}function Do(v,S){S instanceof Map?S.forEach((U,k)=>{h.fillStyle=Zt=k,h.fill(U)}):S!=null&&v&&h.fill(S)}function pm(v,S,U,k){let X=R[v],st;if(k<=0)st=[0,0];else{let ut=X._space=X.space(n,v,S,U,k),_t=X._incrs=X.incrs(n,v,S,U,k,ut);st=FE(S,U,_t,k,ut)}return X._found=st}function sl(v,S,U,k,X,st,ut,_t,yt,kt){let Ft=ut%2/2;p==1&&h.translate(Ft,Ft),_e(_t,ut,yt,kt,_t),h.beginPath();let zt,te,Re,de,ce=X+(k==0||k==3?-st:st);U==0?(te=X,de=ce):(zt=X,Re=ce);for(let ie=0;ie<v.length;ie++)S[ie]!=null&&(U==0?zt=Re=v[ie]:te=de=v[ie],h.moveTo(zt,te),h.lineTo(Re,de));h.stroke(),p==1&&h.translate(-Ft,-Ft)}function mm(v){let S=!0;return R.forEach((U,k)=>{if(!U.show)return;let X=D[U.scale];if(X.min==null){U._show&&(S=!1,U._show=!1,Ws(!1));return}else U._show||(S=!1,U._show=!0,Ws(!1));let st=U.side,ut=st%2,{min:_t,max:yt}=X,[kt,Ft]=pm(k,_t,yt,ut==0?V:it);if(Ft==0)return;let zt=X.distr==2,te=U._splits=U.splits(n,k,_t,yt,kt,Ft,zt),Re=X.distr==2?te.map(Yt=>vt[Yt]):te,de=X.distr==2?vt[te[1]]-vt[te[0]]:kt,ce=U._values=U.values(n,U.filter(n,Re,k,Ft,de),k,Ft,de);U._rotate=st==2?U.rotate(n,ce,k,Ft):0;let ie=U._size;U._size=Kn(U.size(n,ce,k,v)),ie!=null&&U._size!=ie&&(S=!1)}),S}function gm(v){let S=!0;return Co.forEach((U,k)=>{let X=U(n,k,di,v);X!=T[k]&&(S=!1),T[k]=X}),S}function _m(){for(let v=0;v<R.length;v++){let S=R[v];if(!S.show||!S._show)continue;let U=S.side,k=U%2,X,st,ut=S.stroke(n,v),_t=U==0||U==3?-1:1;if(S.label){let Tn=S.labelGap*_t,On=tn((S._lpos+Tn)*xe);Pn(S.labelFont[0],ut,"center",U==2?lo:Df),h.save(),k==1?(X=st=0,h.translate(On,tn(Rt+$t/2)),h.rotate((U==3?-Ta:Ta)/2)):(X=tn(mt+jt/2),st=On),h.fillText(S.label,X,st),h.restore()}let[yt,kt]=S._found;if(kt==0)continue;let Ft=D[S.scale],zt=k==0?jt:$t,te=k==0?mt:Rt,Re=tn(S.gap*xe),de=S._splits,ce=Ft.distr==2?de.map(Tn=>vt[Tn]):de,ie=Ft.distr==2?vt[de[1]]-vt[de[0]]:yt,Yt=S.ticks,we=S.border,je=Yt.show?tn(Yt.size*xe):0,Xe=S._rotate*-Ta/180,Ne=d(S._pos*xe),$e=(je+Re)*_t,Ln=Ne+$e;st=k==0?Ln:0,X=k==1?Ln:0;let Dn=S.font[0],Xn=S.align==1?pr:S.align==2?Jl:Xe>0?pr:Xe<0?Jl:k==0?"center":U==3?Jl:pr,ii=Xe||k==1?"middle":U==2?lo:Df;Pn(Dn,ut,Xn,ii);let si=S.font[1]*S.lineGap,wn=de.map(Tn=>d(l(Tn,Ft,zt,te))),vi=S._values;for(let Tn=0;Tn<vi.length;Tn++){let On=vi[Tn];if(On!=null){k==0?X=wn[Tn]:st=wn[Tn],On=""+On;let Qs=On.indexOf(`
`)==-1?[On]:On.split(/\n/gm);for(let qi=0;qi<Qs.length;qi++){let qn=Qs[qi];Xe?(h.save(),h.translate(X,st+qi*si),h.rotate(Xe),h.fillText(qn,0,0),h.restore()):h.fillText(qn,X,st+qi*si)}}}Yt.show&&sl(wn,Yt.filter(n,ce,v,kt,ie),k,U,Ne,je,Pe(Yt.width*xe,3),Yt.stroke(n,v),Yt.dash,Yt.cap);let bn=S.grid;bn.show&&sl(wn,bn.filter(n,ce,v,kt,ie),k,k==0?2:1,k==0?Rt:mt,k==0?$t:jt,Pe(bn.width*xe,3),bn.stroke(n,v),bn.dash,bn.cap),we.show&&sl([Ne],[1],k==0?1:0,k==0?1:2,k==1?Rt:mt,k==1?$t:jt,Pe(we.width*xe,3),we.stroke(n,v),we.dash,we.cap)}hn("drawAxes")}function Ws(v){b.forEach((S,U)=>{U>0&&(S._paths=null,v&&(s==1?(S.min=null,S.max=null):S.facets.forEach(k=>{k.min=null,k.max=null})))})}let Io=!1,rl=!1,jr=[];function vm(){rl=!1;for(let v=0;v<jr.length;v++)hn(...jr[v]);jr.length=0}function Xs(){Io||(LS($h),Io=!0)}function xm(v,S=!1){Io=!0,rl=S,v(n),$h(),S&&jr.length>0&&queueMicrotask(vm)}n.batch=xm;function $h(){if(Lt&&(qr(),Lt=!1),Qt&&(Bt(),Qt=!1),ne){if(ke(x,pr,ht),ke(x,lo,nt),ke(x,uo,V),ke(x,fo,it),ke(M,pr,ht),ke(M,lo,nt),ke(M,uo,V),ke(M,fo,it),ke(_,uo,L),ke(_,fo,w),f.width=tn(L*xe),f.height=tn(w*xe),R.forEach(({_el:v,_show:S,_size:U,_pos:k,side:X})=>{if(v!=null)if(S){let st=X===3||X===0?U:0,ut=X%2==1;ke(v,ut?"left":"top",k-st),ke(v,ut?"width":"height",U),ke(v,ut?"top":"left",ut?nt:ht),ke(v,ut?"height":"width",ut?it:V),sh(v,Rs)}else zn(v,Rs)}),Jt=Zt=qt=Ee=De=dn=me=Kt=ge=null,Ae=1,Zr(!0),ht!=It||nt!=wt||V!=Ut||it!=re){Ws(!1);let v=V/Ut,S=it/re;if(bt.show&&!pe&&bt.left>=0){bt.left*=v,bt.top*=S,qs&&xi(qs,tn(bt.left),0,V,it),Ys&&xi(Ys,0,tn(bt.top),V,it);for(let U=0;U<gn.length;U++){let k=gn[U];k!=null&&(Ai[U]*=v,Ri[U]*=S,xi(k,Kn(Ai[U]),Kn(Ri[U]),V,it))}}if(Ue.show&&!q&&Ue.left>=0&&Ue.width>0){Ue.left*=v,Ue.width*=v,Ue.top*=S,Ue.height*=S;for(let U in ul)ke($s,U,Ue[U])}It=ht,wt=nt,Ut=V,re=it}hn("setSize"),ne=!1}L>0&&w>0&&(h.clearRect(0,0,f.width,f.height),hn("drawClear"),O.forEach(v=>v()),hn("draw")),Ue.show&&q&&(Uo(Ue),q=!1),bt.show&&pe&&(gs(null,!0,!1),pe=!1),xt.show&&xt.live&&Tt&&(cl(),Tt=!1),c||(c=!0,n.status=1,hn("ready")),Ct=!1,Io=!1}n.redraw=(v,S)=>{Qt=S||!1,v!==!1?Vi(y,m.min,m.max):Xs()};function ol(v,S){let U=D[v];if(U.from==null){if(W==0){let k=U.range(n,S.min,S.max,v);S.min=k[0],S.max=k[1]}if(S.min>S.max){let k=S.min;S.min=S.max,S.max=k}if(W>1&&S.min!=null&&S.max!=null&&S.max-S.min<1e-16)return;v==y&&U.distr==2&&W>0&&(S.min=ci(S.min,t[0]),S.max=ci(S.max,t[0]),S.min==S.max&&S.max++),B[v]=S,Lt=!0,Xs()}}n.setScale=ol;let al,ll,qs,Ys,Zh,Jh,js,Ks,Qh,tu,Ie,ze,Gi=!1;const pn=bt.drag;let ln=pn.x,cn=pn.y;bt.show&&(bt.x&&(al=jn(eS,M)),bt.y&&(ll=jn(nS,M)),m.ori==0?(qs=al,Ys=ll):(qs=ll,Ys=al),Ie=bt.left,ze=bt.top);const Ue=n.select=Je({show:!0,over:!0,left:0,width:0,top:0,height:0},i.select),$s=Ue.show?jn(tS,Ue.over?M:x):null;function Uo(v,S){if(Ue.show){for(let U in v)Ue[U]=v[U],U in ul&&ke($s,U,v[U]);S!==!1&&hn("setSelect")}}n.setSelect=Uo;function Mm(v,S){let U=b[v],k=Vt?Z[v]:null;if(U.show)k&&sh(k,Rs);else{k&&zn(k,Rs);let X=Cn?gn[0]:gn[v];xi(X,-10,-10,V,it)}}function Vi(v,S,U){ol(v,{min:S,max:U})}function gi(v,S,U,k){S.focus!=null&&bm(v),S.show!=null&&b.forEach((X,st)=>{st>0&&(v==st||v==null)&&(X.show=S.show,Mm(st,S.show),s==2?(Vi(X.facets[0].scale,null,null),Vi(X.facets[1].scale,null,null)):Vi(X.scale,null,null),Xs())}),U!==!1&&hn("setSeries",v,S),k&&Jr("setSeries",n,v,S)}n.setSeries=gi;function ym(v,S){Je(A[v],S)}function Sm(v,S){v.fill=he(v.fill||null),v.dir=ve(v.dir,-1),S=S??A.length,A.splice(S,0,v)}function Em(v){v==null?A.length=0:A.splice(v,1)}n.addBand=Sm,n.setBand=ym,n.delBand=Em;function wm(v,S){b[v].alpha=S,bt.show&&gn[v]&&(gn[v].style.opacity=S),Vt&&Z[v]&&(Z[v].style.opacity=S)}let Ci,Wi,ms;const Zs={focus:!0};function bm(v){if(v!=ms){let S=v==null,U=ni.alpha!=1;b.forEach((k,X)=>{if(s==1||X>0){let st=S||X==0||X==v;k._focus=S?null:st,U&&wm(X,st?1:ni.alpha)}}),ms=v,U&&Xs()}}Vt&&Ti&&Et(Of,pt,v=>{bt._lock||(We(v),ms!=null&&gi(null,Zs,!0,Ke.setSeries))});function _i(v,S,U){let k=D[S];U&&(v=v/xe-(k.ori==1?nt:ht));let X=V;k.ori==1&&(X=it,v=X-v),k.dir==-1&&(v=X-v);let st=k._min,ut=k._max,_t=v/X,yt=st+(ut-st)*_t,kt=k.distr;return kt==3?Ur(10,yt):kt==4?xS(yt,k.asinh):kt==100?k.bwd(yt):yt}function Tm(v,S){let U=_i(v,y,S);return ci(U,t[0],tt,et)}n.valToIdx=v=>ci(v,t[0]),n.posToIdx=Tm,n.posToVal=_i,n.valToPos=(v,S,U)=>D[S].ori==0?o(v,D[S],U?jt:V,U?mt:0):a(v,D[S],U?$t:it,U?Rt:0),n.setCursor=(v,S,U)=>{Ie=v.left,ze=v.top,gs(null,S,U)};function eu(v,S){ke($s,pr,Ue.left=v),ke($s,uo,Ue.width=S)}function nu(v,S){ke($s,lo,Ue.top=v),ke($s,fo,Ue.height=S)}let Kr=m.ori==0?eu:nu,$r=m.ori==1?eu:nu;function Am(){if(Vt&&xt.live)for(let v=s==2?1:0;v<b.length;v++){if(v==0&&ot)continue;let S=xt.values[v],U=0;for(let k in S)J[v][U++].firstChild.nodeValue=S[k]}}function cl(v,S){if(v!=null&&(v.idxs?v.idxs.forEach((U,k)=>{gt[k]=U}):ES(v.idx)||gt.fill(v.idx),xt.idx=gt[0]),Vt&&xt.live){for(let U=0;U<b.length;U++)(U>0||s==1&&!ot)&&Rm(U,gt[U]);Am()}Tt=!1,S!==!1&&hn("setLegend")}n.setLegend=cl;function Rm(v,S){let U=b[v],k=v==0&&E==2?vt:t[v],X;ot?X=U.values(n,v,S)??at:(X=U.value(n,S==null?null:k[S],v,S),X=X==null?at:{_:X}),xt.values[v]=X}function gs(v,S,U){Qh=Ie,tu=ze,[Ie,ze]=bt.move(n,Ie,ze),bt.left=Ie,bt.top=ze,bt.show&&(qs&&xi(qs,tn(Ie),0,V,it),Ys&&xi(Ys,0,tn(ze),V,it));let k,X=tt>et;Ci=ue,Wi=null;let st=m.ori==0?V:it,ut=m.ori==1?V:it;if(Ie<0||W==0||X){k=bt.idx=null;for(let _t=0;_t<b.length;_t++){let yt=gn[_t];yt!=null&&xi(yt,-10,-10,V,it)}Ti&&gi(null,Zs,!0,v==null&&Ke.setSeries),xt.live&&(gt.fill(k),Tt=!0)}else{let _t,yt,kt;s==1&&(_t=m.ori==0?Ie:ze,yt=_i(_t,y),k=bt.idx=ci(yt,t[0],tt,et),kt=N(t[0][k],m,st,0));let Ft=-10,zt=-10,te=0,Re=0,de=!0,ce="",ie="";for(let Yt=s==2?1:0;Yt<b.length;Yt++){let we=b[Yt],je=gt[Yt],Xe=je==null?null:s==1?t[Yt][je]:t[Yt][1][je],Ne=bt.dataIdx(n,Yt,k,yt),$e=Ne==null?null:s==1?t[Yt][Ne]:t[Yt][1][Ne];Tt=Tt||$e!=Xe||Ne!=je,gt[Yt]=Ne;let Ln=Ne==k?kt:N(s==1?t[0][Ne]:t[Yt][0][Ne],m,st,0);if(Yt>0&&we.show){let Dn=$e==null?-10:F($e,s==1?D[we.scale]:D[we.facets[1].scale],ut,0);if(Ti&&$e!=null){let Xn=m.ori==1?Ie:ze,ii=nn(ni.dist(n,Yt,Ne,Dn,Xn));if(ii<Ci){let si=ni.bias;if(si!=0){let wn=_i(Xn,we.scale),vi=$e>=0?1:-1,bn=wn>=0?1:-1;bn==vi&&(bn==1?si==1?$e>=wn:$e<=wn:si==1?$e<=wn:$e>=wn)&&(Ci=ii,Wi=Yt)}else Ci=ii,Wi=Yt}}if(Tt||Cn){let Xn,ii;m.ori==0?(Xn=Ln,ii=Dn):(Xn=Dn,ii=Ln);let si,wn,vi,bn,Tn,On,Qs=!0,qi=Le.bbox;if(qi!=null){Qs=!1;let qn=qi(n,Yt);vi=qn.left,bn=qn.top,si=qn.width,wn=qn.height}else vi=Xn,bn=ii,si=wn=Le.size(n,Yt);if(On=Le.fill(n,Yt),Tn=Le.stroke(n,Yt),Cn)Yt==Wi&&Ci<=ni.prox&&(Ft=vi,zt=bn,te=si,Re=wn,de=Qs,ce=On,ie=Tn);else{let qn=gn[Yt];qn!=null&&(Ai[Yt]=vi,Ri[Yt]=bn,Wf(qn,si,wn,Qs),Gf(qn,On,Tn),xi(qn,Kn(vi),Kn(bn),V,it))}}}}if(Cn){let Yt=ni.prox,we=ms==null?Ci<=Yt:Ci>Yt||Wi!=ms;if(Tt||we){let je=gn[0];Ai[0]=Ft,Ri[0]=zt,Wf(je,te,Re,de),Gf(je,ce,ie),xi(je,Kn(Ft),Kn(zt),V,it)}}}if(Ue.show&&Gi)if(v!=null){let[_t,yt]=Ke.scales,[kt,Ft]=Ke.match,[zt,te]=v.cursor.sync.scales,Re=v.cursor.drag;if(ln=Re._x,cn=Re._y,ln||cn){let{left:de,top:ce,width:ie,height:Yt}=v.select,we=v.scales[zt].ori,je=v.posToVal,Xe,Ne,$e,Ln,Dn,Xn=_t!=null&&kt(_t,zt),ii=yt!=null&&Ft(yt,te);Xn&&ln?(we==0?(Xe=de,Ne=ie):(Xe=ce,Ne=Yt),$e=D[_t],Ln=N(je(Xe,zt),$e,st,0),Dn=N(je(Xe+Ne,zt),$e,st,0),Kr(Jn(Ln,Dn),nn(Dn-Ln))):Kr(0,st),ii&&cn?(we==1?(Xe=de,Ne=ie):(Xe=ce,Ne=Yt),$e=D[yt],Ln=F(je(Xe,te),$e,ut,0),Dn=F(je(Xe+Ne,te),$e,ut,0),$r(Jn(Ln,Dn),nn(Dn-Ln))):$r(0,ut)}else No()}else{let _t=nn(Qh-Zh),yt=nn(tu-Jh);if(m.ori==1){let te=_t;_t=yt,yt=te}ln=pn.x&&_t>=pn.dist,cn=pn.y&&yt>=pn.dist;let kt=pn.uni;kt!=null?ln&&cn&&(ln=_t>=kt,cn=yt>=kt,!ln&&!cn&&(yt>_t?cn=!0:ln=!0)):pn.x&&pn.y&&(ln||cn)&&(ln=cn=!0);let Ft,zt;ln&&(m.ori==0?(Ft=js,zt=Ie):(Ft=Ks,zt=ze),Kr(Jn(Ft,zt),nn(zt-Ft)),cn||$r(0,ut)),cn&&(m.ori==1?(Ft=js,zt=Ie):(Ft=Ks,zt=ze),$r(Jn(Ft,zt),nn(zt-Ft)),ln||Kr(0,st)),!ln&&!cn&&(Kr(0,0),$r(0,0))}if(pn._x=ln,pn._y=cn,v==null){if(U){if(du!=null){let[_t,yt]=Ke.scales;Ke.values[0]=_t!=null?_i(m.ori==0?Ie:ze,_t):null,Ke.values[1]=yt!=null?_i(m.ori==1?Ie:ze,yt):null}Jr(Uf,n,Ie,ze,V,it,k)}if(Ti){let _t=U&&Ke.setSeries,yt=ni.prox;ms==null?Ci<=yt&&gi(Wi,Zs,!0,_t):Ci>yt?gi(null,Zs,!0,_t):Wi!=ms&&gi(Wi,Zs,!0,_t)}}Tt&&(xt.idx=k,cl()),S!==!1&&hn("setCursor")}let Xi=null;Object.defineProperty(n,"rect",{get(){return Xi==null&&Zr(!1),Xi}});function Zr(v=!1){v?Xi=null:(Xi=M.getBoundingClientRect(),hn("syncRect",Xi))}function iu(v,S,U,k,X,st,ut){bt._lock||Gi&&v!=null&&v.movementX==0&&v.movementY==0||(hl(v,S,U,k,X,st,ut,!1,v!=null),v!=null?gs(null,!0,!0):gs(S,!0,!1))}function hl(v,S,U,k,X,st,ut,_t,yt){if(Xi==null&&Zr(!1),We(v),v!=null)U=v.clientX-Xi.left,k=v.clientY-Xi.top;else{if(U<0||k<0){Ie=-10,ze=-10;return}let[kt,Ft]=Ke.scales,zt=S.cursor.sync,[te,Re]=zt.values,[de,ce]=zt.scales,[ie,Yt]=Ke.match,we=S.axes[0].side%2==1,je=m.ori==0?V:it,Xe=m.ori==1?V:it,Ne=we?st:X,$e=we?X:st,Ln=we?k:U,Dn=we?U:k;if(de!=null?U=ie(kt,de)?l(te,D[kt],je,0):-10:U=je*(Ln/Ne),ce!=null?k=Yt(Ft,ce)?l(Re,D[Ft],Xe,0):-10:k=Xe*(Dn/$e),m.ori==1){let Xn=U;U=k,k=Xn}}yt&&((U<=1||U>=V-1)&&(U=ws(U,V)),(k<=1||k>=it-1)&&(k=ws(k,it))),_t?(Zh=U,Jh=k,[js,Ks]=bt.move(n,U,k)):(Ie=U,ze=k)}const ul={width:0,height:0,left:0,top:0};function No(){Uo(ul,!1)}let su,ru,ou,au;function lu(v,S,U,k,X,st,ut){Gi=!0,ln=cn=pn._x=pn._y=!1,hl(v,S,U,k,X,st,ut,!0,!1),v!=null&&(Et(Ql,nh,cu,!1),Jr(Nf,n,js,Ks,V,it,null));let{left:_t,top:yt,width:kt,height:Ft}=Ue;su=_t,ru=yt,ou=kt,au=Ft,No()}function cu(v,S,U,k,X,st,ut){Gi=pn._x=pn._y=!1,hl(v,S,U,k,X,st,ut,!1,!0);let{left:_t,top:yt,width:kt,height:Ft}=Ue,zt=kt>0||Ft>0,te=su!=_t||ru!=yt||ou!=kt||au!=Ft;if(zt&&te&&Uo(Ue),pn.setScale&&zt&&te){let Re=_t,de=kt,ce=yt,ie=Ft;if(m.ori==1&&(Re=yt,de=Ft,ce=_t,ie=kt),ln&&Vi(y,_i(Re,y),_i(Re+de,y)),cn)for(let Yt in D){let we=D[Yt];Yt!=y&&we.from==null&&we.min!=ue&&Vi(Yt,_i(ce+ie,Yt),_i(ce,Yt))}No()}else bt.lock&&(bt._lock=!bt._lock,gs(null,!0,!1));v!=null&&(Xt(Ql,nh),Jr(Ql,n,Ie,ze,V,it,null))}function Cm(v,S,U,k,X,st,ut){if(bt._lock)return;We(v);let _t=Gi;if(Gi){let yt=!0,kt=!0,Ft=10,zt,te;m.ori==0?(zt=ln,te=cn):(zt=cn,te=ln),zt&&te&&(yt=Ie<=Ft||Ie>=V-Ft,kt=ze<=Ft||ze>=it-Ft),zt&&yt&&(Ie=Ie<js?0:V),te&&kt&&(ze=ze<Ks?0:it),gs(null,!0,!0),Gi=!1}Ie=-10,ze=-10,gs(null,!0,!0),_t&&(Gi=_t)}function hu(v,S,U,k,X,st,ut){bt._lock||(We(v),Wt(),No(),v!=null&&Jr(Ff,n,Ie,ze,V,it,null))}function uu(){R.forEach(BE),lt(n.width,n.height,!0)}Is(Fa,Tr,uu);const Js={};Js.mousedown=lu,Js.mousemove=iu,Js.mouseup=cu,Js.dblclick=hu,Js.setSeries=(v,S,U,k)=>{let X=Ke.match[2];U=X(n,S,U),U!=-1&&gi(U,k,!0,!1)},bt.show&&(Et(Nf,M,lu),Et(Uf,M,iu),Et(kf,M,v=>{We(v),Zr(!1)}),Et(Of,M,Cm),Et(Ff,M,hu),hh.add(n),n.syncRect=Zr);const ko=n.hooks=i.hooks||{};function hn(v,S,U){rl?jr.push([v,S,U]):v in ko&&ko[v].forEach(k=>{k.call(null,n,S,U)})}(i.plugins||[]).forEach(v=>{for(let S in v.hooks)ko[S]=(ko[S]||[]).concat(v.hooks[S])});const fu=(v,S,U)=>U,Ke=Je({key:null,setSeries:!1,filters:{pub:Kf,sub:Kf},scales:[y,b[1]?b[1].scale:null],match:[$f,$f,fu],values:[null,null]},bt.sync);Ke.match.length==2&&Ke.match.push(fu),bt.sync=Ke;const du=Ke.key,fl=qp(du);function Jr(v,S,U,k,X,st,ut){Ke.filters.pub(v,S,U,k,X,st,ut)&&fl.pub(v,S,U,k,X,st,ut)}fl.sub(n);function Pm(v,S,U,k,X,st,ut){Ke.filters.sub(v,S,U,k,X,st,ut)&&Js[v](null,S,U,k,X,st,ut)}n.pub=Pm;function Lm(){fl.unsub(n),hh.delete(n),At.clear(),rh(Fa,Tr,uu),u.remove(),pt?.remove(),hn("destroy")}n.destroy=Lm;function dl(){hn("init",i,t),Gt(t||i.data,!1),B[y]?ol(y,B[y]):Wt(),q=Ue.show&&(Ue.width>0||Ue.height>0),pe=Tt=!0,lt(i.width,i.height)}return b.forEach(Xr),R.forEach(il),e?e instanceof HTMLElement?(e.appendChild(u),dl()):e(n,dl):dl(),n}yn.assign=Je;yn.fmtNum=zh;yn.rangeNum=Ba;yn.rangeLog=$a;yn.rangeAsinh=Fh;yn.orient=zs;yn.pxRatio=xe;yn.join=PS;yn.fmtDate=Gh,yn.tzDate=HS;yn.sync=qp;{yn.addGap=EE,yn.clipGaps=Qa;let i=yn.paths={points:Jp};i.linear=tm,i.stepped=TE,i.bars=AE,i.spline=CE}const vd=56;class zE{constructor(){this.node=z("div",{class:"spark",role:"img"}),this.plot=null,this.colours="",this.width=0}draw(t,e,n,s){this.node.setAttribute("aria-label",s);const r=Math.floor(this.node.clientWidth);if(r<20)return;const o=getComputedStyle(document.documentElement),a=o.getPropertyValue("--accent").trim(),l=o.getPropertyValue("--red").trim();this.plot===null||this.colours!==a?this.build(r,a,l):this.width!==r&&this.plot.setSize({width:r,height:vd}),this.width=r,this.plot?.setData([t,e,t.map(()=>n)])}build(t,e,n){this.plot?.destroy(),this.colours=e,this.plot=new yn({width:t,height:vd,padding:[4,0,4,0],legend:{show:!1},cursor:{show:!1},select:{show:!1,left:0,top:0,width:0,height:0},axes:[{show:!1},{show:!1}],scales:{x:{time:!1,range:[-eh,0]},y:{range:(s,r,o)=>[Math.min(0,r??0),Math.max(o??0,.001)*1.1]}},series:[{},{stroke:e,width:1.5,points:{show:!1}},{stroke:n,width:1,dash:[4,4],points:{show:!1}}]},[[],[],[]],this.node)}}const ma=["gate","force","rtt","loss","gap","age","margin","trips","late","temperature","link"];function HE(i,t){const e=Dh(i),n=t?.force_limit_n??null;return{gate:{text:ls("gate",i.gate),band:xp(i.gate)},force:{text:H("cards.of_limit",{f:en(e,2,"N"),limit:en(n,1,"N")}),band:_p(Ih(i,t))},rtt:{text:en(i.rtt_ms,1,"ms"),band:Ls(i.rtt_ms,pp)},loss:{text:en(i.loss_percent,1,"%"),band:Ls(i.loss_percent,mp)},gap:{text:en(i.gap_ms,1,"ms"),band:Ls(i.gap_ms,Lh)},age:{text:en(i.age_ms,1,"ms"),band:Ls(i.age_ms,zy)},margin:{text:en(i.margin_j===null?null:i.margin_j*1e3,1,"mJ"),band:vp(i.margin_j)},trips:{text:en(i.trips,0),band:i.trips===null?"unknown":i.trips>0?"amber":"green"},late:{text:en(i.late,0),band:i.late===null?"unknown":i.late>0?"amber":"green"},temperature:{text:en(i.temperature_c,0,"°C"),band:Mp(i.temperature_c)},link:{text:H(`band.${th(i)}`),band:th(i)}}}class GE{constructor(t){this.page=t,this.grid=z("div",{class:"cards"}),this.quantity="force",this.cards=[],this.known=null,this.sparkAt=0;const e=ti(yp.map(n=>[n,H(`quantity.${n}`)]),"force",n=>{this.quantity=n,this.sparkAt=0});this.node=Vn(H("cards.title"),"cards-panel",z("div",{class:"row"},qe(H("cards.quantity"),e)),this.grid)}update(){const{scene:t,state:e}=this.page.model;if(!t)return;t!==this.known&&this.adopt(t);const n=performance.now(),s=n-this.sparkAt>500;s&&(this.sparkAt=n),this.cards.forEach((r,o)=>{const a=e?.seats[o];if(!a)return;const l=HE(a,t.seats[o]),c=ma.map(f=>l[f].band),u=a.taken!==!1;rs(r.node,"data-band",u?a.heard===!1?"red":gp(c):"unknown"),r.node.classList.toggle("free",!u),Se(r.person,u?a.person??"":H("who.free")),r.meter.value=Math.min(1,Ih(a,t.seats[o])??0);for(const f of ma)Se(r.cells[f],l[f].text),rs(r.cells[f],"data-band",l[f].band),rs(r.cells[f],"title",H(`level.${l[f].band}`));s&&this.drawSpark(r,o,t.seats[o])})}drawSpark(t,e,n){const[s,r]=this.page.model.history.series(e,this.quantity),o={force:n?.force_limit_n??null,rtt:null,loss:null,margin:null}[this.quantity],a=H("cards.spark",{quantity:H(`quantity.${this.quantity}`),seat:n?.name??"",value:en(r[r.length-1],2)});t.spark.draw(s,r,o,a)}adopt(t){this.known=t,this.cards=t.seats.map((e,n)=>{const s=Object.fromEntries(ma.map(u=>[u,z("dd")])),r=z("span",{class:"person"}),o=z("meter",{min:0,max:1,low:.8,high:.999,optimum:0,"aria-label":`${e.name}: ${H("cards.force")}`}),a=new zE,l=ma.map(u=>z("div",{},z("dt",{},H(`cards.${u}`)),s[u]));return{node:z("article",{class:"card","aria-label":e.name},z("h3",{},Ka(n),e.name,r),o,a.node,z("dl",{},...l)),person:r,meter:o,cells:s,spark:a}}),this.sparkAt=0,this.grid.replaceChildren(...this.cards.map(e=>e.node))}}function VE(i){return!i||i.taken===null?wi:i.taken?i.heard===!1?H("who.lost"):i.engaged===null?wi:H(i.engaged?"who.engaged":"who.released"):H("who.free")}class WE{constructor(t){this.page=t,this.rows=z("tbody"),this.cells=[],this.known=null,this.drain=Fe(H("stop.drain"),()=>void this.askDrain());const e=["seat","person","role","device","state"].map(n=>z("th",{scope:"col"},H(`who.${n}`)));this.node=Vn(H("who.title"),"who-panel",z("div",{class:"scroll",tabindex:0,role:"group","aria-label":H("who.title")},z("table",{},z("thead",{},z("tr",{},...e,z("td"))),this.rows)),z("div",{class:"row"},this.drain))}update(){const{model:t}=this.page;t.scene&&t.scene!==this.known&&this.adopt(t.scene),this.cells.forEach((e,n)=>{const s=t.state?.seats[n];Se(e.person,s?.person??wi),Se(e.state,VE(s)),e.state.classList.toggle("bad",s?.taken===!0&&s.heard===!1),Te(e.remove,!t.may("remove")||s?.taken!==!0),e.remove.hidden=!t.granted("remove")}),this.drain.hidden=!t.granted("drain"),Te(this.drain,!t.may("drain"))}adopt(t){this.known=t,this.cells=t.seats.map(e=>({person:z("td"),state:z("td"),remove:Fe(H("stop.remove"),()=>void this.askRemove(e.name),{"aria-label":`${H("stop.remove")} ${e.name}`})})),this.rows.replaceChildren(...t.seats.map((e,n)=>{const s=this.cells[n];return z("tr",{},z("th",{scope:"row"},Ka(n),e.name),s?.person??null,z("td",{},ls("role",e.role)),z("td",{},e.device??wi),s?.state??null,z("td",{class:"end"},s?.remove??null))}))}async askRemove(t){const e=z("input",{type:"text",maxlength:200}),n=H("who.remove_title",{seat:t}),s=await vu(n,"",e,H("who.reason"),H("stop.remove").replace("…",""),H("who.cancel"));s!==null&&this.page.order(n,{order:"remove",seat:t,why:s||H("stop.why")})}async askDrain(){const t=z("input",{type:"number",min:0,max:3600,step:1,value:"30",required:!0}),e=H("drain.title"),n=H("stop.drain").replace("…",""),s=await vu(e,H("drain.explain"),t,H("drain.grace"),n,H("who.cancel"));s!==null&&this.page.order(e,{order:"drain",grace_s:Math.round(Number(s))})}}class XE{constructor(t){this.page=t,this.slot=z("div",{class:"slot"});const e=new By(t),n=new WE(t),s=new GE(t),r=new Ld(t);this.parts=[e,n,s,r],this.node=z("div",{class:"view instructor-view"},z("div",{class:"column"},this.slot,n.node),z("div",{class:"column"},e.node,r.node),z("div",{class:"column wide"},s.node))}shown(){this.slot.append(this.page.pictureHost)}update(){for(const t of this.parts)t.update()}}class qE{constructor(t,e){this.joined=e,this.ticket=z("input",{type:"password",autocomplete:"off",required:!0,maxlength:4096}),this.name=z("input",{type:"text",autocomplete:"name",required:!0,maxlength:64}),this.go=z("button",{type:"submit",class:"primary"},H("join.go")),this.problem=z("p",{class:"problem",role:"alert"}),this.ticket.value=t?.ticket??"",this.name.value=t?.name??"",this.node=z("div",{class:"view join-view"},Vn(H("join.title"),"join-panel",z("p",{},H("join.explain")),z("form",{onsubmit:n=>{n.preventDefault(),this.send()}},qe(H("join.ticket"),this.ticket),qe(H("join.name"),this.name),this.go),this.problem))}async send(){Te(this.go,!0),Se(this.problem,"");try{const t=await fetch("/join",{method:"POST",headers:{"Content-Type":"application/json"},body:JSON.stringify({ticket:this.ticket.value,name:this.name.value})});t.ok?(this.ticket.value="",this.joined()):Se(this.problem,await YE(t))}catch{Se(this.problem,H("join.failed"))}Te(this.go,!1)}}async function YE(i){try{const t=await i.json();if(typeof t=="object"&&t!==null&&"text"in t&&typeof t.text=="string")return t.text.slice(0,500)}catch{}return`${H("join.failed")} (${i.status})`}const jE=4,KE=4e3;class xd{constructor(){this.node=z("div",{class:"messages",role:"log","aria-live":"polite","aria-label":H("notices.title")})}show(t,e){[...this.node.children].find(r=>r.firstChild?.textContent===e)?.remove();const s=z("div",{class:`message ${t}`,role:t==="error"?"alert":void 0},z("p",{},e),Fe("✕",()=>s.remove(),{"aria-label":H("notices.dismiss"),class:"quiet"}));for(this.node.append(s);this.node.childElementCount>jE;)this.node.firstElementChild?.remove();t==="info"&&setTimeout(()=>s.remove(),KE)}}const Md={type:"change"},Kh={type:"start"},sm={type:"end"},ga=new wh,yd=new Qi,$E=Math.cos(70*p_.DEG2RAD),Qe=new $,Un=2*Math.PI,be={NONE:-1,ROTATE:0,DOLLY:1,PAN:2,TOUCH_ROTATE:3,TOUCH_PAN:4,TOUCH_DOLLY_PAN:5,TOUCH_DOLLY_ROTATE:6},sc=1e-6;class ZE extends Oy{constructor(t,e=null){super(t,e),this.state=be.NONE,this.enabled=!0,this.target=new $,this.cursor=new $,this.minDistance=0,this.maxDistance=1/0,this.minZoom=0,this.maxZoom=1/0,this.minTargetRadius=0,this.maxTargetRadius=1/0,this.minPolarAngle=0,this.maxPolarAngle=Math.PI,this.minAzimuthAngle=-1/0,this.maxAzimuthAngle=1/0,this.enableDamping=!1,this.dampingFactor=.05,this.enableZoom=!0,this.zoomSpeed=1,this.enableRotate=!0,this.rotateSpeed=1,this.enablePan=!0,this.panSpeed=1,this.screenSpacePanning=!0,this.keyPanSpeed=7,this.zoomToCursor=!1,this.autoRotate=!1,this.autoRotateSpeed=2,this.keys={LEFT:"ArrowLeft",UP:"ArrowUp",RIGHT:"ArrowRight",BOTTOM:"ArrowDown"},this.mouseButtons={LEFT:Sr.ROTATE,MIDDLE:Sr.DOLLY,RIGHT:Sr.PAN},this.touches={ONE:vr.ROTATE,TWO:vr.DOLLY_PAN},this.target0=this.target.clone(),this.position0=this.object.position.clone(),this.zoom0=this.object.zoom,this._domElementKeyEvents=null,this._lastPosition=new $,this._lastQuaternion=new Os,this._lastTargetPosition=new $,this._quat=new Os().setFromUnitVectors(t.up,new $(0,1,0)),this._quatInverse=this._quat.clone().invert(),this._spherical=new bf,this._sphericalDelta=new bf,this._scale=1,this._panOffset=new $,this._rotateStart=new se,this._rotateEnd=new se,this._rotateDelta=new se,this._panStart=new se,this._panEnd=new se,this._panDelta=new se,this._dollyStart=new se,this._dollyEnd=new se,this._dollyDelta=new se,this._dollyDirection=new $,this._mouse=new se,this._performCursorZoom=!1,this._pointers=[],this._pointerPositions={},this._controlActive=!1,this._onPointerMove=QE.bind(this),this._onPointerDown=JE.bind(this),this._onPointerUp=t1.bind(this),this._onContextMenu=a1.bind(this),this._onMouseWheel=i1.bind(this),this._onKeyDown=s1.bind(this),this._onTouchStart=r1.bind(this),this._onTouchMove=o1.bind(this),this._onMouseDown=e1.bind(this),this._onMouseMove=n1.bind(this),this._interceptControlDown=l1.bind(this),this._interceptControlUp=c1.bind(this),this.domElement!==null&&this.connect(),this.update()}connect(){this.domElement.addEventListener("pointerdown",this._onPointerDown),this.domElement.addEventListener("pointercancel",this._onPointerUp),this.domElement.addEventListener("contextmenu",this._onContextMenu),this.domElement.addEventListener("wheel",this._onMouseWheel,{passive:!1}),this.domElement.getRootNode().addEventListener("keydown",this._interceptControlDown,{passive:!0,capture:!0}),this.domElement.style.touchAction="none"}disconnect(){this.domElement.removeEventListener("pointerdown",this._onPointerDown),this.domElement.removeEventListener("pointermove",this._onPointerMove),this.domElement.removeEventListener("pointerup",this._onPointerUp),this.domElement.removeEventListener("pointercancel",this._onPointerUp),this.domElement.removeEventListener("wheel",this._onMouseWheel),this.domElement.removeEventListener("contextmenu",this._onContextMenu),this.stopListenToKeyEvents(),this.domElement.getRootNode().removeEventListener("keydown",this._interceptControlDown,{capture:!0}),this.domElement.style.touchAction="auto"}dispose(){this.disconnect()}getPolarAngle(){return this._spherical.phi}getAzimuthalAngle(){return this._spherical.theta}getDistance(){return this.object.position.distanceTo(this.target)}listenToKeyEvents(t){t.addEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=t}stopListenToKeyEvents(){this._domElementKeyEvents!==null&&(this._domElementKeyEvents.removeEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=null)}saveState(){this.target0.copy(this.target),this.position0.copy(this.object.position),this.zoom0=this.object.zoom}reset(){this.target.copy(this.target0),this.object.position.copy(this.position0),this.object.zoom=this.zoom0,this.object.updateProjectionMatrix(),this.dispatchEvent(Md),this.update(),this.state=be.NONE}update(t=null){const e=this.object.position;Qe.copy(e).sub(this.target),Qe.applyQuaternion(this._quat),this._spherical.setFromVector3(Qe),this.autoRotate&&this.state===be.NONE&&this._rotateLeft(this._getAutoRotationAngle(t)),this.enableDamping?(this._spherical.theta+=this._sphericalDelta.theta*this.dampingFactor,this._spherical.phi+=this._sphericalDelta.phi*this.dampingFactor):(this._spherical.theta+=this._sphericalDelta.theta,this._spherical.phi+=this._sphericalDelta.phi);let n=this.minAzimuthAngle,s=this.maxAzimuthAngle;isFinite(n)&&isFinite(s)&&(n<-Math.PI?n+=Un:n>Math.PI&&(n-=Un),s<-Math.PI?s+=Un:s>Math.PI&&(s-=Un),n<=s?this._spherical.theta=Math.max(n,Math.min(s,this._spherical.theta)):this._spherical.theta=this._spherical.theta>(n+s)/2?Math.max(n,this._spherical.theta):Math.min(s,this._spherical.theta)),this._spherical.phi=Math.max(this.minPolarAngle,Math.min(this.maxPolarAngle,this._spherical.phi)),this._spherical.makeSafe(),this.enableDamping===!0?this.target.addScaledVector(this._panOffset,this.dampingFactor):this.target.add(this._panOffset),this.target.sub(this.cursor),this.target.clampLength(this.minTargetRadius,this.maxTargetRadius),this.target.add(this.cursor);let r=!1;if(this.zoomToCursor&&this._performCursorZoom||this.object.isOrthographicCamera)this._spherical.radius=this._clampDistance(this._spherical.radius);else{const o=this._spherical.radius;this._spherical.radius=this._clampDistance(this._spherical.radius*this._scale),r=o!=this._spherical.radius}if(Qe.setFromSpherical(this._spherical),Qe.applyQuaternion(this._quatInverse),e.copy(this.target).add(Qe),this.object.lookAt(this.target),this.enableDamping===!0?(this._sphericalDelta.theta*=1-this.dampingFactor,this._sphericalDelta.phi*=1-this.dampingFactor,this._panOffset.multiplyScalar(1-this.dampingFactor)):(this._sphericalDelta.set(0,0,0),this._panOffset.set(0,0,0)),this.zoomToCursor&&this._performCursorZoom){let o=null;if(this.object.isPerspectiveCamera){const a=Qe.length();o=this._clampDistance(a*this._scale);const l=a-o;this.object.position.addScaledVector(this._dollyDirection,l),this.object.updateMatrixWorld(),r=!!l}else if(this.object.isOrthographicCamera){const a=new $(this._mouse.x,this._mouse.y,0);a.unproject(this.object);const l=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),this.object.updateProjectionMatrix(),r=l!==this.object.zoom;const c=new $(this._mouse.x,this._mouse.y,0);c.unproject(this.object),this.object.position.sub(c).add(a),this.object.updateMatrixWorld(),o=Qe.length()}else console.warn("WARNING: OrbitControls.js encountered an unknown camera type - zoom to cursor disabled."),this.zoomToCursor=!1;o!==null&&(this.screenSpacePanning?this.target.set(0,0,-1).transformDirection(this.object.matrix).multiplyScalar(o).add(this.object.position):(ga.origin.copy(this.object.position),ga.direction.set(0,0,-1).transformDirection(this.object.matrix),Math.abs(this.object.up.dot(ga.direction))<$E?this.object.lookAt(this.target):(yd.setFromNormalAndCoplanarPoint(this.object.up,this.target),ga.intersectPlane(yd,this.target))))}else if(this.object.isOrthographicCamera){const o=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),o!==this.object.zoom&&(this.object.updateProjectionMatrix(),r=!0)}return this._scale=1,this._performCursorZoom=!1,r||this._lastPosition.distanceToSquared(this.object.position)>sc||8*(1-this._lastQuaternion.dot(this.object.quaternion))>sc||this._lastTargetPosition.distanceToSquared(this.target)>sc?(this.dispatchEvent(Md),this._lastPosition.copy(this.object.position),this._lastQuaternion.copy(this.object.quaternion),this._lastTargetPosition.copy(this.target),!0):!1}_getAutoRotationAngle(t){return t!==null?Un/60*this.autoRotateSpeed*t:Un/60/60*this.autoRotateSpeed}_getZoomScale(t){const e=Math.abs(t*.01);return Math.pow(.95,this.zoomSpeed*e)}_rotateLeft(t){this._sphericalDelta.theta-=t}_rotateUp(t){this._sphericalDelta.phi-=t}_panLeft(t,e){Qe.setFromMatrixColumn(e,0),Qe.multiplyScalar(-t),this._panOffset.add(Qe)}_panUp(t,e){this.screenSpacePanning===!0?Qe.setFromMatrixColumn(e,1):(Qe.setFromMatrixColumn(e,0),Qe.crossVectors(this.object.up,Qe)),Qe.multiplyScalar(t),this._panOffset.add(Qe)}_pan(t,e){const n=this.domElement;if(this.object.isPerspectiveCamera){const s=this.object.position;Qe.copy(s).sub(this.target);let r=Qe.length();r*=Math.tan(this.object.fov/2*Math.PI/180),this._panLeft(2*t*r/n.clientHeight,this.object.matrix),this._panUp(2*e*r/n.clientHeight,this.object.matrix)}else this.object.isOrthographicCamera?(this._panLeft(t*(this.object.right-this.object.left)/this.object.zoom/n.clientWidth,this.object.matrix),this._panUp(e*(this.object.top-this.object.bottom)/this.object.zoom/n.clientHeight,this.object.matrix)):(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - pan disabled."),this.enablePan=!1)}_dollyOut(t){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale/=t:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_dollyIn(t){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale*=t:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_updateZoomParameters(t,e){if(!this.zoomToCursor)return;this._performCursorZoom=!0;const n=this.domElement.getBoundingClientRect(),s=t-n.left,r=e-n.top,o=n.width,a=n.height;this._mouse.x=s/o*2-1,this._mouse.y=-(r/a)*2+1,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()}_clampDistance(t){return Math.max(this.minDistance,Math.min(this.maxDistance,t))}_handleMouseDownRotate(t){this._rotateStart.set(t.clientX,t.clientY)}_handleMouseDownDolly(t){this._updateZoomParameters(t.clientX,t.clientX),this._dollyStart.set(t.clientX,t.clientY)}_handleMouseDownPan(t){this._panStart.set(t.clientX,t.clientY)}_handleMouseMoveRotate(t){this._rotateEnd.set(t.clientX,t.clientY),this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);const e=this.domElement;this._rotateLeft(Un*this._rotateDelta.x/e.clientHeight),this._rotateUp(Un*this._rotateDelta.y/e.clientHeight),this._rotateStart.copy(this._rotateEnd),this.update()}_handleMouseMoveDolly(t){this._dollyEnd.set(t.clientX,t.clientY),this._dollyDelta.subVectors(this._dollyEnd,this._dollyStart),this._dollyDelta.y>0?this._dollyOut(this._getZoomScale(this._dollyDelta.y)):this._dollyDelta.y<0&&this._dollyIn(this._getZoomScale(this._dollyDelta.y)),this._dollyStart.copy(this._dollyEnd),this.update()}_handleMouseMovePan(t){this._panEnd.set(t.clientX,t.clientY),this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd),this.update()}_handleMouseWheel(t){this._updateZoomParameters(t.clientX,t.clientY),t.deltaY<0?this._dollyIn(this._getZoomScale(t.deltaY)):t.deltaY>0&&this._dollyOut(this._getZoomScale(t.deltaY)),this.update()}_handleKeyDown(t){let e=!1;switch(t.code){case this.keys.UP:t.ctrlKey||t.metaKey||t.shiftKey?this._rotateUp(Un*this.rotateSpeed/this.domElement.clientHeight):this._pan(0,this.keyPanSpeed),e=!0;break;case this.keys.BOTTOM:t.ctrlKey||t.metaKey||t.shiftKey?this._rotateUp(-Un*this.rotateSpeed/this.domElement.clientHeight):this._pan(0,-this.keyPanSpeed),e=!0;break;case this.keys.LEFT:t.ctrlKey||t.metaKey||t.shiftKey?this._rotateLeft(Un*this.rotateSpeed/this.domElement.clientHeight):this._pan(this.keyPanSpeed,0),e=!0;break;case this.keys.RIGHT:t.ctrlKey||t.metaKey||t.shiftKey?this._rotateLeft(-Un*this.rotateSpeed/this.domElement.clientHeight):this._pan(-this.keyPanSpeed,0),e=!0;break}e&&(t.preventDefault(),this.update())}_handleTouchStartRotate(t){if(this._pointers.length===1)this._rotateStart.set(t.pageX,t.pageY);else{const e=this._getSecondPointerPosition(t),n=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._rotateStart.set(n,s)}}_handleTouchStartPan(t){if(this._pointers.length===1)this._panStart.set(t.pageX,t.pageY);else{const e=this._getSecondPointerPosition(t),n=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._panStart.set(n,s)}}_handleTouchStartDolly(t){const e=this._getSecondPointerPosition(t),n=t.pageX-e.x,s=t.pageY-e.y,r=Math.sqrt(n*n+s*s);this._dollyStart.set(0,r)}_handleTouchStartDollyPan(t){this.enableZoom&&this._handleTouchStartDolly(t),this.enablePan&&this._handleTouchStartPan(t)}_handleTouchStartDollyRotate(t){this.enableZoom&&this._handleTouchStartDolly(t),this.enableRotate&&this._handleTouchStartRotate(t)}_handleTouchMoveRotate(t){if(this._pointers.length==1)this._rotateEnd.set(t.pageX,t.pageY);else{const n=this._getSecondPointerPosition(t),s=.5*(t.pageX+n.x),r=.5*(t.pageY+n.y);this._rotateEnd.set(s,r)}this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);const e=this.domElement;this._rotateLeft(Un*this._rotateDelta.x/e.clientHeight),this._rotateUp(Un*this._rotateDelta.y/e.clientHeight),this._rotateStart.copy(this._rotateEnd)}_handleTouchMovePan(t){if(this._pointers.length===1)this._panEnd.set(t.pageX,t.pageY);else{const e=this._getSecondPointerPosition(t),n=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._panEnd.set(n,s)}this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd)}_handleTouchMoveDolly(t){const e=this._getSecondPointerPosition(t),n=t.pageX-e.x,s=t.pageY-e.y,r=Math.sqrt(n*n+s*s);this._dollyEnd.set(0,r),this._dollyDelta.set(0,Math.pow(this._dollyEnd.y/this._dollyStart.y,this.zoomSpeed)),this._dollyOut(this._dollyDelta.y),this._dollyStart.copy(this._dollyEnd);const o=(t.pageX+e.x)*.5,a=(t.pageY+e.y)*.5;this._updateZoomParameters(o,a)}_handleTouchMoveDollyPan(t){this.enableZoom&&this._handleTouchMoveDolly(t),this.enablePan&&this._handleTouchMovePan(t)}_handleTouchMoveDollyRotate(t){this.enableZoom&&this._handleTouchMoveDolly(t),this.enableRotate&&this._handleTouchMoveRotate(t)}_addPointer(t){this._pointers.push(t.pointerId)}_removePointer(t){delete this._pointerPositions[t.pointerId];for(let e=0;e<this._pointers.length;e++)if(this._pointers[e]==t.pointerId){this._pointers.splice(e,1);return}}_isTrackingPointer(t){for(let e=0;e<this._pointers.length;e++)if(this._pointers[e]==t.pointerId)return!0;return!1}_trackPointer(t){let e=this._pointerPositions[t.pointerId];e===void 0&&(e=new se,this._pointerPositions[t.pointerId]=e),e.set(t.pageX,t.pageY)}_getSecondPointerPosition(t){const e=t.pointerId===this._pointers[0]?this._pointers[1]:this._pointers[0];return this._pointerPositions[e]}_customWheelEvent(t){const e=t.deltaMode,n={clientX:t.clientX,clientY:t.clientY,deltaY:t.deltaY};switch(e){case 1:n.deltaY*=16;break;case 2:n.deltaY*=100;break}return t.ctrlKey&&!this._controlActive&&(n.deltaY*=10),n}}function JE(i){this.enabled!==!1&&(this._pointers.length===0&&(this.domElement.setPointerCapture(i.pointerId),this.domElement.addEventListener("pointermove",this._onPointerMove),this.domElement.addEventListener("pointerup",this._onPointerUp)),!this._isTrackingPointer(i)&&(this._addPointer(i),i.pointerType==="touch"?this._onTouchStart(i):this._onMouseDown(i)))}function QE(i){this.enabled!==!1&&(i.pointerType==="touch"?this._onTouchMove(i):this._onMouseMove(i))}function t1(i){switch(this._removePointer(i),this._pointers.length){case 0:this.domElement.releasePointerCapture(i.pointerId),this.domElement.removeEventListener("pointermove",this._onPointerMove),this.domElement.removeEventListener("pointerup",this._onPointerUp),this.dispatchEvent(sm),this.state=be.NONE;break;case 1:const t=this._pointers[0],e=this._pointerPositions[t];this._onTouchStart({pointerId:t,pageX:e.x,pageY:e.y});break}}function e1(i){let t;switch(i.button){case 0:t=this.mouseButtons.LEFT;break;case 1:t=this.mouseButtons.MIDDLE;break;case 2:t=this.mouseButtons.RIGHT;break;default:t=-1}switch(t){case Sr.DOLLY:if(this.enableZoom===!1)return;this._handleMouseDownDolly(i),this.state=be.DOLLY;break;case Sr.ROTATE:if(i.ctrlKey||i.metaKey||i.shiftKey){if(this.enablePan===!1)return;this._handleMouseDownPan(i),this.state=be.PAN}else{if(this.enableRotate===!1)return;this._handleMouseDownRotate(i),this.state=be.ROTATE}break;case Sr.PAN:if(i.ctrlKey||i.metaKey||i.shiftKey){if(this.enableRotate===!1)return;this._handleMouseDownRotate(i),this.state=be.ROTATE}else{if(this.enablePan===!1)return;this._handleMouseDownPan(i),this.state=be.PAN}break;default:this.state=be.NONE}this.state!==be.NONE&&this.dispatchEvent(Kh)}function n1(i){switch(this.state){case be.ROTATE:if(this.enableRotate===!1)return;this._handleMouseMoveRotate(i);break;case be.DOLLY:if(this.enableZoom===!1)return;this._handleMouseMoveDolly(i);break;case be.PAN:if(this.enablePan===!1)return;this._handleMouseMovePan(i);break}}function i1(i){this.enabled===!1||this.enableZoom===!1||this.state!==be.NONE||(i.preventDefault(),this.dispatchEvent(Kh),this._handleMouseWheel(this._customWheelEvent(i)),this.dispatchEvent(sm))}function s1(i){this.enabled===!1||this.enablePan===!1||this._handleKeyDown(i)}function r1(i){switch(this._trackPointer(i),this._pointers.length){case 1:switch(this.touches.ONE){case vr.ROTATE:if(this.enableRotate===!1)return;this._handleTouchStartRotate(i),this.state=be.TOUCH_ROTATE;break;case vr.PAN:if(this.enablePan===!1)return;this._handleTouchStartPan(i),this.state=be.TOUCH_PAN;break;default:this.state=be.NONE}break;case 2:switch(this.touches.TWO){case vr.DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchStartDollyPan(i),this.state=be.TOUCH_DOLLY_PAN;break;case vr.DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchStartDollyRotate(i),this.state=be.TOUCH_DOLLY_ROTATE;break;default:this.state=be.NONE}break;default:this.state=be.NONE}this.state!==be.NONE&&this.dispatchEvent(Kh)}function o1(i){switch(this._trackPointer(i),this.state){case be.TOUCH_ROTATE:if(this.enableRotate===!1)return;this._handleTouchMoveRotate(i),this.update();break;case be.TOUCH_PAN:if(this.enablePan===!1)return;this._handleTouchMovePan(i),this.update();break;case be.TOUCH_DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchMoveDollyPan(i),this.update();break;case be.TOUCH_DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchMoveDollyRotate(i),this.update();break;default:this.state=be.NONE}}function a1(i){this.enabled!==!1&&i.preventDefault()}function l1(i){i.key==="Control"&&(this._controlActive=!0,this.domElement.getRootNode().addEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}function c1(i){i.key==="Control"&&(this._controlActive=!1,this.domElement.getRootNode().removeEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}const h1=.25,_a=.12;class u1{constructor(t){this.camera=new $n(38,1,.01,3),this.chosen="free",this.goal=new $,this.target=new $,this.zoom=1,this.camera.up.set(0,0,1),this.controls=new ZE(this.camera,t),this.controls.enablePan=!1,this.controls.enableDamping=!1,this.controls.minDistance=.06,this.controls.maxDistance=.8,t.addEventListener("keydown",e=>this.onKey(e)),this.choose("free")}get choice(){return this.chosen}choose(t){this.chosen=t,this.zoom=1,this.controls.enabled=t==="free",this.controls.target.set(0,0,0),t==="free"&&this.camera.position.set(-.07,-.18,.09),this.controls.update()}resize(t){this.camera.aspect=t,this.camera.fov=t<1.2?Math.min(75,38*(1.2/t)):38,this.camera.updateProjectionMatrix()}update(t,e){if(this.chosen==="free")return;const n=h1/this.zoom;if(this.chosen==="front")this.place([0,-n,.02],[0,0,0],1);else if(this.chosen==="above")this.place([0,-.001,n],[0,0,0],1);else if(t){const s=[t[0],t[1]-.6*n,t[2]+.25*n];this.place(s,t,e?1:.12)}}place(t,e,n){this.goal.set(...t),this.camera.position.lerp(this.goal,n),this.target.lerp(this.goal.set(...e),n),this.camera.lookAt(this.target)}onKey(t){const n={ArrowLeft:[-_a,0],ArrowRight:[_a,0],ArrowUp:[0,_a],ArrowDown:[0,-_a]}[t.key];if(t.key==="+"||t.key==="-"){const s=t.key==="+"?1.15:.8695652173913044;this.zoom=Math.min(4,Math.max(.4,this.zoom*s)),this.chosen==="free"&&this.camera.position.multiplyScalar(1/s).clampLength(.06,.8)}else if(n&&this.chosen==="free"){const{x:s,y:r,z:o}=this.camera.position,[a,l]=[Math.hypot(s,r,o),Math.atan2(r,s)+n[0]],c=Math.min(1.45,Math.max(-1.45,Math.asin(o/a)+n[1])),u=a*Math.cos(c);this.camera.position.set(u*Math.cos(l),u*Math.sin(l),a*Math.sin(c))}else return;this.controls.update(),t.preventDefault(),t.stopPropagation()}}const f1=.06,d1=.02;class rm{constructor(){this.arrow=new ky(new $(1,0,0),new $,.01),this.direction=new $}set(t,e,n,s,r){const o=e?Math.hypot(...e):0;if(this.arrow.visible=r&&t!==null&&e!==null&&o>d1&&Number.isFinite(o),!this.arrow.visible||!t||!e)return;const a=Math.min(f1,o*n);this.arrow.position.set(t[0],t[1],t[2]),this.arrow.setDirection(this.direction.set(e[0]/o,e[1]/o,e[2]/o)),this.arrow.setLength(a,Math.min(.004,a*.5),.0026),this.arrow.setColor(s)}dispose(){this.arrow.dispose()}}function p1(i){const t=Math.max(.1,i/4),e=10**Math.floor(Math.log10(t)+1e-9);return([1,2,5,10].find(s=>s*e>=t*(1-1e-9))??10)*e}const Sd=26,m1=90;class g1{constructor(t){this.node=document.createElement("span"),this.swatch=document.createElement("i"),this.words=document.createElement("span"),this.node.className="name-label",this.swatch.style.background=t,this.node.append(this.swatch,this.words)}set(t,e){this.words.textContent!==t&&(this.words.textContent=t),this.node.classList.toggle("alarm",e)}show(t){this.node.hidden===t&&(this.node.hidden=!t)}place(t,e){this.node.style.transform=`translate(-50%, -100%) translate(${Math.round(t)}px, ${Math.round(e)}px)`}}function _1(i){const t=[];for(const e of i){const n=r=>t.some(o=>Math.abs(o.x-e.x)<m1&&Math.abs(o.y-r)<Sd);let s=e.y;for(let r=0;r<2*i.length&&n(s);r+=1)s-=Sd;t.push({x:e.x,y:s})}return t}const rc=3,vo=180;class v1{constructor(){this.points=new yo(vo)}get length(){return this.points.length}clear(){this.points.clear()}push(t,e){const n=this.points.newest;n&&t<n.t&&this.clear(),this.points.dropWhile(s=>t-s.t>rc),e!==null&&(n&&t-n.t<rc/vo-1e-9&&this.points.length>0||this.points.push({t,x:e}))}write(t,e,n){const s=Math.min(this.points.length,e.length,Math.floor(t.length/3));for(let r=0;r<s;r+=1){const o=this.points.at(r);o&&(t.set(o.x,3*r),e[r]=Math.max(0,1-(n-o.t)/rc))}return s}}class om{constructor(){this.trail=new v1,this.positions=new Float32Array(3*vo),this.shares=new Float32Array(vo),this.colours=new Float32Array(3*vo),this.geometry=new Sn,this.mixed=new ee,this.geometry.setAttribute("position",new ei(this.positions,3)),this.geometry.setAttribute("color",new ei(this.colours,3)),this.line=new Ah(this.geometry,new Ao({vertexColors:!0})),this.line.frustumCulled=!1}update(t,e,n,s,r){if(this.trail.push(t,e),this.line.visible=r,!r)return;const o=this.trail.write(this.positions,this.shares,t);for(let a=0;a<o;a+=1)this.mixed.lerpColors(s,n,this.shares[a]??0).toArray(this.colours,3*a);this.geometry.setDrawRange(0,o);for(const a of Object.values(this.geometry.attributes))a.needsUpdate=!0}dispose(){this.geometry.dispose(),this.line.material.dispose()}}const x1=new ja(.0042,20,14),M1=new qa(.0017,.0026,.02,12),y1=new Ch(.0066,7e-4,6,24);class S1{constructor(t){this.index=t,this.group=new fi,this.body=new fi,this.place=new $,this.force=new rm,this.trail=new om,this.colour=new ee(Oa(t)),this.label=new g1(Oa(t)),this.material=new Ph({color:this.colour,transparent:!0,opacity:.62});const e=new sn(M1,this.material);e.rotation.set(Math.PI/2+.6,0,0),e.position.set(0,-.006,.009),this.ring=new sn(y1,new Br({color:"#b42318"})),this.body.add(new sn(x1,this.material),e,this.ring),this.group.add(this.body,this.force.arrow,this.trail.line)}update(t,e,n,s,r){const o=t.x!==null&&t.taken!==!1;if(this.body.visible=o,this.label.show(o&&r.names),this.trail.update(n,o?t.x:null,this.colour,s.background,r.trails),this.force.set(o?t.x:null,t.f,r.forceScale,this.colour,r.forces),!o||!t.x)return;this.body.position.set(t.x[0],t.x[1],t.x[2]),this.material.opacity=t.heard===!1?.2:t.engaged===!1?.34:.72;const a=Uh(t,e);this.ring.visible=a,a&&(this.ring.material.color.copy(s.limit),this.ring.scale.setScalar(r.reducedMotion?1.2:1.15+.2*Math.abs(Math.sin(n*6))));const l=e?.name??String(this.index+1);this.label.set(a?`${l} · ${H("picture.limit")}`:l,a)}get top(){return this.place.copy(this.body.position).setZ(this.body.position.z+.021)}face(t){this.ring.quaternion.copy(t)}dispose(){this.material.dispose(),this.ring.material.dispose(),this.force.dispose(),this.trail.dispose()}}const oc=.09,Ed=.008;function wd(i,t,e){const n=[oc,oc,oc];n[i.axis]=Ed;const s=new zr(...n),r=t==="wall"?e.wall:e.tissue,o=new sn(s,new Ph({color:r,transparent:!0,opacity:t==="wall"?.42:.3,depthWrite:!1})),a=new Rh(new Py(s),new Ao({color:r})),l=new fi;l.add(o,a);const c=i.from_below?1:-1;return l.position.setComponent(i.axis,i.at_m+c*Ed/2),l}function E1(i,t){const e=new fi,n=new Ny(.2,20,t.grid,t.grid);n.rotation.x=Math.PI/2,n.position.z=-.065,e.add(n);for(const s of i){for(const r of s.walls)e.add(wd(r,"wall",t));for(const r of s.tissues)e.add(wd(r,"tissue",t))}return e}function w1(i){i.traverse(t=>{if(t instanceof sn||t instanceof Rh){t.geometry.dispose();for(const e of[t.material].flat())e.dispose()}})}const b1=new ja(.003,20,14),T1=new Ya(.0045,.0062,32),A1=.0092,R1=.0112,ac=.06;class C1{constructor(){this.group=new fi,this.shown=""}update(t,e){const n=t.map(r=>Math.round(r*200)).join(",")+e.join(",");if(n===this.shown)return;this.shown=n,this.clear();let s=Math.PI/2;t.forEach((r,o)=>{const a=r*2*Math.PI;if(a>ac*1.5){const l=new Ya(A1,R1,48,1,s-a+ac/2,a-ac);this.group.add(new sn(l,new Br({color:Oa(e[o]??o),side:2})))}s-=a})}clear(){for(const t of[...this.group.children])t instanceof sn&&(t.geometry.dispose(),t.material.dispose()),this.group.remove(t)}}function P1(i,t){const e=[...i];for(const n of[...t?.walls??[],...t?.tissues??[]])(n.from_below?i[n.axis]>=n.at_m:i[n.axis]<=n.at_m)&&(e[n.axis]=n.at_m);return e}class L1{constructor(){this.group=new fi,this.body=new fi,this.material=new Ph,this.bars=new C1,this.contact=new sn(T1,new Br({side:2})),this.force=new rm,this.trail=new om,this.colour=new ee,this.body.add(new sn(b1,this.material),this.bars.group),this.group.add(this.body,this.contact,this.force.arrow,this.trail.line)}update(t,e,n,s,r,o){const a=t.x,l=t.touching===!0&&a!==null;this.body.visible=a!==null,this.contact.visible=l,this.colour.copy(l?r.contact:r.tool),this.material.color.copy(this.colour),this.trail.update(n.t,a,this.colour,r.background,o.trails),this.force.set(a,t.f,o.forceScale,this.colour,o.forces),a&&(this.body.position.set(a[0],a[1],a[2]),this.bars.update(t.applied??t.wanted??[],s),l&&(this.contact.material.color.copy(r.contact),this.contact.position.set(...P1(a,e)),this.contact.scale.setScalar(1+Math.min(2,(t.depth_m??0)/.002))))}face(t){this.bars.group.quaternion.copy(t),this.contact.quaternion.copy(t)}dispose(){this.bars.clear(),this.material.dispose(),this.contact.material.dispose(),this.force.dispose(),this.trail.dispose()}}const lc=26,va=14,bd=.5,D1=3.3;class I1{constructor(t){this.canvas=document.createElement("canvas"),this.labels=document.createElement("div"),this.options={trails:!0,forces:!0,names:!0,forceScale:.01,reducedMotion:!1},this.scene=new Cy,this.surfaces=null,this.hands=new Map,this.tools=new Map,this.known=null,this.ratio=Math.min(2,window.devicePixelRatio||1),this.frameTime=va,this.last=0,this.size="",this.frames=0,this.labels.className="labels",this.labels.ariaHidden="true",this.canvas.tabIndex=0,this.canvas.setAttribute("role","img"),this.canvas.setAttribute("aria-label",t),this.renderer=new Ry({canvas:this.canvas,antialias:this.ratio<1.5&&!U1(),powerPreference:"low-power"}),this.colours=Af(document.documentElement),this.rig=new u1(this.canvas);const e=new Iy("#ffffff",2);e.position.set(.2,-.4,.6),this.scene.add(new Uy("#ffffff",1.6),e)}get forceOf10mm(){return .01/this.options.forceScale}recolour(){this.colours=Af(document.documentElement),this.known=null}draw(t,e,n){this.fit()&&(this.adapt(n),t&&t!==this.known&&this.adopt(t),t&&e&&this.update(t,e),this.renderer.render(this.scene,this.rig.camera),this.frames+=1)}adopt(t){const e=this.known?.session!==t.session;this.known=t,this.scene.background=this.colours.background,this.surfaces&&(this.scene.remove(this.surfaces),w1(this.surfaces)),this.surfaces=E1(t.tools,this.colours),this.scene.add(this.surfaces),e&&this.clear();const n=t.seats.map(s=>s.force_limit_n??0);this.options.forceScale=.01/p1(Math.max(...n,0)||D1)}clear(){for(const t of[...this.hands.values(),...this.tools.values()])this.scene.remove(t.group),t.dispose();this.hands.clear(),this.labels.replaceChildren(),this.tools.clear()}update(t,e){const n=t.seats.map((o,a)=>o.kind==="MASTER"?a:-1).filter(o=>o>=0);e.seats.forEach((o,a)=>{t.seats[a]?.kind!=="SLAVE"&&this.hand(a).update(o,t.seats[a],e.t,this.colours,this.options)}),e.tools.forEach((o,a)=>{this.tool(a).update(o,t.tools[a],e,n,this.colours,this.options)});const s=this.rig.choice,r=s.startsWith("seat:")?e.seats[Number(s.slice(5))]:void 0;this.rig.update(r?.x??null,this.options.reducedMotion);for(const o of[...this.hands.values(),...this.tools.values()])o.face(this.rig.camera.quaternion);this.options.names&&this.placeLabels()}placeLabels(){const{clientWidth:t,clientHeight:e}=this.canvas,n=[...this.hands.values()];this.rig.camera.updateMatrixWorld();const s=n.map(r=>{const o=r.top.project(this.rig.camera);return{x:(o.x+1)/2*t,y:(1-o.y)/2*e}});_1(s).forEach((r,o)=>n[o]?.label.place(r.x,r.y))}hand(t){const e=this.hands.get(t);if(e)return e;const n=new S1(t);return this.hands.set(t,n),this.labels.append(n.label.node),this.scene.add(n.group),n}tool(t){const e=this.tools.get(t);if(e)return e;const n=new L1;return this.tools.set(t,n),this.scene.add(n.group),n}fit(){const t=this.canvas.parentElement;if(!t)return!1;const[e,n]=[t.clientWidth,t.clientHeight];if(e<2||n<2)return!1;const s=`${e} ${n} ${this.ratio}`;return s===this.size||(this.size=s,this.renderer.setPixelRatio(this.ratio),this.renderer.setSize(e,n),this.rig.resize(e/n)),!0}adapt(t){const e=t-this.last;if(this.last=t,!(e>0&&e<250))return;this.frameTime+=(e-this.frameTime)*.05;const n=Math.min(2,window.devicePixelRatio||1);this.frameTime>lc&&this.ratio>bd?(this.ratio=Math.max(bd,this.ratio*.8),this.frameTime=(lc+va)/2):this.frameTime<va&&this.ratio<n&&(this.ratio=Math.min(n,this.ratio*1.1),this.frameTime=(lc+va)/2)}}function U1(){const i=document.createElement("canvas").getContext("webgl2"),t=i?.getExtension("WEBGL_debug_renderer_info"),e=i&&t?i.getParameter(t.UNMASKED_RENDERER_WEBGL):"";return i?.getExtension("WEBGL_lose_context")?.loseContext(),typeof e=="string"&&/swiftshader|llvmpipe|software/i.test(e)}class N1{constructor(t){this.model=t,this.delay=z("p",{class:"delay"}),this.scale=z("p",{class:"scale"}),this.phase=z("p",{class:"phase-banner"}),this.shownDelay=NaN;let e=null;try{e=new I1(H("picture.label"))}catch{}this.picture=e,this.node=z("div",{class:"picture"},e?.canvas??z("p",{class:"no-picture"},H("picture.none"))),this.node.append(z("div",{class:"overlay"},e?.labels??null,this.delay,this.scale,this.phase));const n=matchMedia("(prefers-reduced-motion: reduce)"),s=()=>{e&&(e.options.reducedMotion=n.matches,n.matches&&(e.options.trails=!1))};n.addEventListener("change",s),s()}frame(t,e){if(this.node.isConnected&&this.picture?.draw(this.model.scene,t?.state??null,e),t){const n=Number.isNaN(this.shownDelay)?1:.1;this.shownDelay=(Number.isNaN(this.shownDelay)?0:this.shownDelay*(1-n))+t.delay_ms*n}}update(t){const{dropped:e}=this.model.acknowledgements,{skipped:n}=this.model.states,s=t?.outOfDate??!1;(s||!t)&&(this.shownDelay=NaN),Se(this.delay,t?s?H("delay.old",{s:en(t.silence_ms/1e3,1,"s")}):H("delay.value",{ms:en(this.shownDelay,0,"ms")}):H("delay.none")),rs(this.delay,"title",H("delay.help",{dropped:e,skipped:n})),this.node.classList.toggle("out-of-date",s);const r=this.picture?.forceOf10mm??0;Se(this.scale,this.picture?.options.forces?H("picture.scale",{n:en(r,r<1?1:0)}):"");const o=t?.state.phase??"RUNNING";Se(this.phase,o==="RUNNING"?"":ls("phase",o)),this.phase.hidden=o==="RUNNING"}}const is=.06,k1=.005,O1=.12,cc=.12,F1=45,mr=i=>Number.isFinite(i)?Math.min(is,Math.max(-is,i)):0;class B1{constructor(){this.position=[0,0,0],this.grips=new Set,this.plane="front"}get x(){return[...this.position]}get pressed(){return this.grips.size>0}grip(t,e){e?this.grips.add(t):this.grips.delete(t)}release(){this.grips.clear()}moveTo(t){this.position=[mr(t[0]),mr(t[1]),mr(t[2])]}pointAt(t,e){this.position[0]=mr(t*is),this.position[this.vertical()]=mr(e*is)}step(t,e){this.position[t]=mr(this.position[t]+e)}stick(t,e){const n=Math.min(.1,Math.max(0,e));t.forEach((s,r)=>{const o=Math.abs(s);if(!(o>cc))return;const a=Math.sign(s)*((Math.min(1,o)-cc)/(1-cc));this.step(r,a*O1*n)})}place(t){return[t[0]/is,t[this.vertical()]/is]}vertical(){return this.plane==="front"?2:1}}const z1={ArrowLeft:[-1,0,0],ArrowRight:[1,0,0],ArrowDown:[0,-1,0],ArrowUp:[0,1,0],PageDown:[0,0,-1],PageUp:[0,0,1]};class H1{constructor(t){this.device=t,this.canvas=z("canvas",{class:"pad",tabindex:0,role:"application","aria-label":H("seat.pad")});const e=n=>{const s=this.canvas.getBoundingClientRect(),r=Math.min(s.width,s.height)/2;t.pointAt((n.clientX-s.left-s.width/2)/r,-(n.clientY-s.top-s.height/2)/r)};this.canvas.addEventListener("pointerdown",n=>{this.canvas.setPointerCapture(n.pointerId),t.grip("pointer",!0),e(n)}),this.canvas.addEventListener("pointermove",n=>{this.canvas.hasPointerCapture(n.pointerId)&&e(n)});for(const n of["pointerup","pointercancel","lostpointercapture"])this.canvas.addEventListener(n,()=>t.grip("pointer",!1));this.canvas.addEventListener("keydown",n=>this.onKey(n))}draw(t,e){const n=Math.min(2,window.devicePixelRatio||1),[s,r]=[this.canvas.clientWidth,this.canvas.clientHeight];if(s<2||r<2)return;this.canvas.width!==Math.round(s*n)&&(this.canvas.width=Math.round(s*n)),this.canvas.height!==Math.round(r*n)&&(this.canvas.height=Math.round(r*n));const o=this.canvas.getContext("2d");if(!o)return;const a=getComputedStyle(this.canvas),l=M=>a.getPropertyValue(M).trim();o.setTransform(n,0,0,n,0,0),o.clearRect(0,0,s,r);const c=Math.min(s,r)/2,u=M=>{const[p,d]=this.device.place(M);return[s/2+p*c,r/2-d*c]};this.grid(o,s,r,c,l("--picture-grid"));const f=u(this.device.x),h=t?.x?u(t.x):null,_=e??0,x=_>=.999?"--red":_>=.8?"--amber":"--accent";h&&(o.strokeStyle=l(x),o.lineWidth=3+5*Math.min(1,_),o.beginPath(),o.moveTo(...f),o.lineTo(...h),o.stroke(),o.fillStyle=l(x),o.beginPath(),o.arc(...h,12,0,2*Math.PI),o.fill()),o.strokeStyle=l("--text"),o.lineWidth=2,o.setLineDash(this.device.pressed?[]:[5,5]),o.beginPath(),o.arc(...f,18,0,2*Math.PI),o.stroke(),o.setLineDash([])}grid(t,e,n,s,r){t.strokeStyle=r,t.lineWidth=1,t.beginPath();const o=.02/is*s;for(let a=-Math.ceil(e/2/o);a<=e/2/o;a+=1)t.moveTo(e/2+a*o,0),t.lineTo(e/2+a*o,n);for(let a=-Math.ceil(n/2/o);a<=n/2/o;a+=1)t.moveTo(0,n/2+a*o),t.lineTo(e,n/2+a*o);t.stroke()}onKey(t){const e=z1[t.key];if(t.key===" ")t.repeat||this.device.grip("key",!this.device.pressed);else if(e){const n=this.device.plane==="front"?[0,2,1]:[0,1,2];e.forEach((s,r)=>this.device.step(n[r]??0,s*k1))}else return;t.preventDefault(),t.stopPropagation()}}class G1{constructor(t){this.page=t,this.device=new B1,this.pad=new H1(this.device),this.slot=z("div",{class:"slot"}),this.choice=ti([],"",()=>{}),this.words=z("p",{role:"status"}),this.force=z("meter",{min:0,max:1,low:.8,high:.999,optimum:0,"aria-label":H("seat.force")}),this.forceText=z("output"),this.gamepad=z("p",{class:"note"},H("seat.gamepad")),this.options="",this.sent_ms=0,this.last_ms=0,this.seat="",this.take=Fe(H("seat.take"),()=>this.takeSeat(),{class:"primary"}),this.leave=Fe(H("seat.leave"),()=>void this.page.request(H("seat.leave"),{type:"leave"})),this.hold=Fe(H("seat.hold"),()=>this.device.grip("button",!this.device.pressed),{"aria-pressed":"false"}),window.addEventListener("blur",()=>this.release()),document.addEventListener("visibilitychange",()=>this.release());const e=ti([["front",H("seat.front")],["above",H("seat.above")]],"front",r=>{this.device.plane=r,Se(this.depthLabel,H(r==="front"?"seat.depth_front":"seat.depth_above"))}),n=is*1e3;this.depth=z("input",{type:"range",min:-n,max:n,step:1,value:"0",oninput:()=>this.moveDepth(Number(this.depth.value)/1e3)});const s=qe(H("seat.depth_front"),this.depth);this.depthLabel=s.querySelector("span")??s,this.node=z("div",{class:"view seat-view"},z("div",{class:"column"},Vn(H("seat.title"),"seat-panel",z("div",{class:"row"},qe(H("seat.choose"),this.choice),this.take,this.leave),this.words,this.pad.canvas,z("div",{class:"row"},this.hold,qe(H("seat.plane"),e),s),z("div",{class:"force"},z("span",{},H("seat.force")),this.force,this.forceText),z("p",{class:"note"},H("seat.explain")),this.gamepad)),z("div",{class:"column"},this.slot))}shown(){this.slot.append(this.page.pictureHost)}hidden(){this.release(),this.page.sound.ownForce(null)}update(){const{model:t}=this.page,e=t.ownSeat?.seat??"";e!==this.seat&&(this.seat=e,t.ownSeat?.x&&this.device.moveTo(t.ownSeat.x));const n=(t.scene?.seats??[]).filter((a,l)=>a.kind==="MASTER"&&t.state?.seats[l]?.taken===!1),s=n.map(a=>a.name).join(`
`);s!==this.options&&(this.options=s,Us(this.choice,n.map(a=>[a.name,a.name]),this.choice.value));const r=t.may("seat");Te(this.take,!r||e!==""||n.length===0),Te(this.choice,!r||e!==""||n.length===0),Te(this.leave,e===""||!r),Te(this.hold,e===""),Te(this.depth,e===""),this.hold.setAttribute("aria-pressed",String(this.device.pressed));const o=H(this.device.pressed?"seat.held":"seat.released");Se(this.words,e!==""?`${H("seat.yours",{seat:e})} ${o}`:H(t.granted("seat")?n.length===0?"seat.none_free":"seat.explain":"seat.not_allowed"))}frame(t,e){const{model:n}=this.page,s=n.ownSeat;this.readGamepad((e-this.last_ms)/1e3),this.last_ms=e,s?.seat&&e-this.sent_ms>=1e3/F1&&(this.sent_ms=e,this.page.connection.signal({type:"pointer",x:this.device.x,pressed:this.device.pressed}));const r=n.scene?.seats.find(c=>c.name===s?.seat)?.force_limit_n??null,o=s?.f?Math.hypot(...s.f):null,a=o===null||r===null?null:o/r;this.force.value=Math.min(1,a??0),Se(this.forceText,en(o,2,"N"));const l=this.device.plane==="front"?1:2;document.activeElement!==this.depth&&(this.depth.value=String(Math.round((this.device.x[l]??0)*1e3))),this.pad.draw(s,a),this.page.sound.ownForce(s?a:null)}release(){this.device.release(),this.page.model.ownSeat?.seat&&this.page.connection.signal({type:"pointer",x:this.device.x,pressed:!1},!0)}takeSeat(){this.choice.value&&this.page.request(H("seat.take"),{type:"take",seat:this.choice.value})}moveDepth(t){const e=this.device.plane==="front"?1:2;this.device.step(e,t-this.device.x[e])}readGamepad(t){const e=navigator.getGamepads?.().find(s=>s!==null&&s.connected)??null;if(Se(this.gamepad,H(e?"seat.gamepad_on":"seat.gamepad")+(e?` ${H("seat.gamepad")}`:"")),!e)return;const n=s=>e.axes[s]??0;this.device.stick([n(0),-n(3),-n(1)],t),this.device.grip("gamepad",e.buttons[0]?.pressed??!1)}}function V1(i){const t=i.by_server?H(i.pseudonyms?"recording.server_pseudonyms":"recording.server"):H("recording.recorders",{count:String(i.by_recorders)});return i.trouble!==""?`${t}. ${H("recording.trouble",{why:i.trouble})}`:i.dropped>0?`${t}. ${H("recording.dropped",{count:String(i.dropped)})}`:t}class W1{constructor(t){this.page=t,this.text=z("span",{}),this.sign=z("span",{class:"recording",role:"status"}),this.change=Fe("",()=>this.order(),{class:"record"}),this.sign.append(z("span",{class:"recording-dot","aria-hidden":"true"}),this.text),this.node=z("span",{class:"recording-mark"},this.sign,this.change)}order(){const t=!this.page.model.state?.recording?.by_server;this.page.order(H(t?"recording.start":"recording.stop"),{order:"record",on:t})}update(){const{model:t}=this.page,e=t.state?.recording??null;this.sign.hidden=e===null,e&&Se(this.text,V1(e)),this.change.hidden=!t.granted("record"),Se(this.change,H(e?.by_server?"recording.stop":"recording.start")),Te(this.change,!t.may("record")||!t.state||t.state.phase==="OVER")}}const am=["live","instructor","evaluator","seat","desk"];function X1(i){const t=tg();Aa(i);const e=H("language.name");return Aa(t),e}class q1{constructor(t,e,n){this.page=t,this.phase=z("span",{class:"badge"}),this.time=z("span",{class:"time"}),this.link=z("span",{class:"link",role:"status"}),this.person=z("span",{class:"person"}),this.invite=Fe(H("bar.invite"),()=>void this.askInvitation()),this.invitation=z("input",{type:"text",readonly:!0,"aria-label":H("bar.invitation")}),this.known=null,this.recording=new W1(t),this.session=ti([],"",l=>{t.request(H("bar.session"),{type:"watch",session:l})}),this.tabs=am.map((l,c)=>Fe(H(`nav.${l}`),()=>n.choose(l),{"data-view":l,"aria-keyshortcuts":String(c+1)}));const s=ti(Object.keys(fh).map(l=>[l,X1(l)]),e.language,l=>n.change({language:l})),r=ti(["auto","light","dark"].map(l=>[l,H(`theme.${l}`)]),e.theme,l=>n.change({theme:l})),o=z("details",{class:"settings"},z("summary",{},H("bar.settings")),z("div",{class:"settings-box"},qe(H("bar.language"),s),qe(H("bar.theme"),r),uc(H("bar.keys"),e.keys,l=>n.change({keys:l})),z("p",{class:"note"},H("bar.keys_help")),this.invite,this.invitation));this.invitation.hidden=!0;const a=uc(H("bar.sound"),t.sound.on,l=>t.sound.switch(l));this.node=z("header",{class:"top-bar"},z("div",{class:"identity"},z("h1",{},"Tandem"),qe(H("bar.session"),this.session),this.phase,this.time,this.recording.node,this.link,this.person,a,o),z("nav",{"aria-label":H("nav.label")},...this.tabs))}async askInvitation(){const t=await this.page.connection.request({type:"invite"});if(!t.ok)return this.page.report("error",H("order.refused",{what:H("bar.invite"),why:t.text}));this.invitation.value=location.origin+t.text,this.invitation.hidden=!1,this.invitation.select()}choose(t){for(const e of this.tabs)rs(e,"aria-current",e.dataset.view===t?"page":null)}update(){const{model:t}=this.page,{hello:e,state:n}=t;e&&e!==this.known&&(this.known=e,Us(this.session,e.sessions.map(s=>[s.id,s.name]),t.scene?.session??""),Se(this.person,H("bar.person",{person:e.person,role:ls("role",e.role)}))),t.scene&&document.activeElement!==this.session&&this.session.value!==t.scene.session&&(this.session.value=t.scene.session),Se(this.phase,n?ls("phase",n.phase):""),rs(this.phase,"data-phase",n?.phase??null),Se(this.time,n?ns(n.t):""),this.recording.update(),Se(this.link,H(`link.${t.link}`)),rs(this.link,"data-link",t.link),Te(this.invite,!t.may("invite"));for(const s of this.tabs){const o={live:null,instructor:null,evaluator:"score",seat:"seat",desk:"create"}[s.dataset.view];s.classList.toggle("denied",o!==null&&!t.granted(o))}}}const lm="tandem";function Y1(){try{const i=JSON.parse(localStorage.getItem(lm)??"{}");return typeof i=="object"&&i!==null?i:{}}catch{return{}}}function j1(){const i=Y1();return{language:i.language==="en"||i.language==="fr"?i.language:eg(navigator.languages),theme:i.theme==="light"||i.theme==="dark"?i.theme:"auto",keys:i.keys!==!1}}function K1(i){try{localStorage.setItem(lm,JSON.stringify(i))}catch{}}class $1{constructor(){this.context=null,this.own=null,this.touching=[],this.nextLimit=0}get on(){return this.context!==null}switch(t){t!==this.on&&(t?this.context=new AudioContext:(this.context?.close(),this.context=null,this.own=null))}update(t,e,n){const s=this.touching;if(this.touching=t.tools.map(o=>o.touching===!0),!this.context)return;this.touching.some((o,a)=>o&&s[a]===!1)&&this.beep(190,.08,.25),t.seats.some((o,a)=>Uh(o,e?.seats[a]))&&n>=this.nextLimit&&(this.nextLimit=n+500,this.beep(980,.06,.12))}ownForce(t){const e=this.context;if(!e)return;if(!this.own){const s=new OscillatorNode(e,{type:"sine",frequency:220}),r=new GainNode(e,{gain:0});s.connect(r).connect(e.destination),s.start(),this.own={tone:s,gain:r}}const n=Math.min(1,Math.max(0,t??0));this.own.tone.frequency.setTargetAtTime(180+360*n,e.currentTime,.03),this.own.gain.gain.setTargetAtTime(.12*n,e.currentTime,.03)}beep(t,e,n){const s=this.context;if(!s)return;const r=new OscillatorNode(s,{type:"sine",frequency:t}),o=new GainNode(s,{gain:n});o.gain.setTargetAtTime(0,s.currentTime+e*.5,e*.2),r.connect(o).connect(s.destination),r.start(),r.stop(s.currentTime+e*2)}}const Z1=100;class J1{constructor(t,e,n){this.model=t,this.connection=e,this.root=n,this.sound=new $1,this.settings=j1(),this.messages=new xd,this.bar=null,this.control=null,this.views=new Map,this.current="live",this.main=z("main",{id:"main",tabindex:-1}),this.join=null,this.prefilled=hg(location.hash),this.lastNotice=null,this.updated_ms=0,this.played=!1,this.dark=matchMedia("(prefers-color-scheme: dark)"),this.prefilled&&history.replaceState(null,"","/"),Aa(this.settings.language),this.host=new N1(t),e.onChange=()=>this.onChange(),this.dark.addEventListener("change",()=>this.paint()),document.addEventListener("keydown",s=>this.onKey(s)),this.build(),requestAnimationFrame(s=>this.onFrame(s)),setInterval(()=>{document.hidden&&this.update()},1e3)}get pictureHost(){return this.host.node}order(t,e){return this.request(t,{type:"order",...e})}async request(t,e){const n=await this.connection.request(e);return n.ok?this.report("info",H("order.sent",{what:t})):this.report("error",H("order.refused",{what:t,why:n.text})),n}report(t,e){this.messages.show(t,e)}build(){document.documentElement.lang=this.settings.language,this.messages=new xd,this.bar=new q1(this,this.settings,{choose:t=>this.choose(t),change:t=>this.change(t)}),this.control=new ug(this),this.views=new Map([["live",new Fy(this,this.host.picture)],["instructor",new XE(this)],["evaluator",new bg(this)],["seat",new G1(this)],["desk",new gg(this)]]),this.main=z("main",{id:"main",tabindex:-1}),this.root.replaceChildren(z("a",{class:"skip",href:"#main"},H("nav.skip")),this.bar.node,this.control.node,this.main,this.messages.node),this.paint(),this.choose(this.current),this.onChange()}change(t){this.settings={...this.settings,...t},K1(this.settings),t.language&&(Aa(t.language),this.host.picture?.canvas.setAttribute("aria-label",H("picture.label")),this.join=null,this.build()),this.paint()}paint(){const{theme:t}=this.settings;document.documentElement.dataset.theme=t==="auto"?this.dark.matches?"dark":"light":t,this.host.picture?.recolour()}choose(t){this.views.get(this.current)?.hidden?.(),this.current=t;const e=this.views.get(t);e&&(this.main.replaceChildren(e.node),e.shown?.(),this.bar?.choose(t),this.update())}onChange(){const{model:t}=this;t.link==="refused"?(this.join??=new qE(this.prefilled,()=>this.connection.reconnect()),this.join.node.isConnected||this.main.replaceChildren(this.join.node)):t.link==="open"&&this.join&&(this.join=null,this.prefilled=null,this.choose(this.current));const e=t.notices.newest;e&&e!==this.lastNotice&&(this.lastNotice=e,this.report(e.level,e.text)),this.update()}play(){const{hello:t,scene:e,state:n}=this.model;if(this.played||!t?.play||!e||!n||!this.model.may("seat"))return;this.played=!0,this.choose("seat"),n.seats[e.seats.findIndex(({name:r})=>r===t.play)]?.taken===!1&&this.request(H("seat.take"),{type:"take",seat:t.play})}update(){this.play(),this.bar?.update(),this.control?.update(),this.host.update(this.model.states.sample(performance.now())),this.join||this.views.get(this.current)?.update()}onFrame(t){requestAnimationFrame(s=>this.onFrame(s));const e=performance.now(),n=this.model.states.sample(e);this.host.frame(n,t),this.connection.acknowledge(),n&&this.sound.update(n.state,this.model.scene,e),this.join||this.views.get(this.current)?.frame?.(n,e),e-this.updated_ms>=Z1&&(this.updated_ms=e,this.update())}onKey(t){if(!this.settings.keys||t.ctrlKey||t.altKey||t.metaKey||t.repeat)return;const e=t.target;if(e instanceof HTMLElement&&(e.matches("input:not([type=range]):not([type=checkbox]):not([type=radio]), textarea, select")||e.closest("dialog")!==null)||this.join)return;const s=t.key.toLowerCase(),r=am[Number(s)-1];if(s==="s")this.control?.order("stop");else if(s==="p")this.control?.order("pause");else if(s==="r")this.control?.order("resume");else if(s==="m")this.views.get("evaluator")?.timeline.mark();else if(r)this.choose(r);else return;t.preventDefault()}}const Q1=200,tw=1;class ew{constructor(){this.alarms=[],this.active=new Map,this.counts=new Map,this.next=1}list(){return[...this.alarms].reverse()}current(){return[...this.active.values()].map(t=>t.alarm)}update(t,e){const n=this.causes(t,e);for(const s of n)this.see(s,t.t);for(const[s,r]of this.active)r.alarm.kind!=="connection"&&(t.t-r.seen>tw||t.t<r.seen)&&this.end(s,t.t)}connection(t,e,n){const s="connection:";t?this.see({kind:"connection",level:"alarm",seat:"",detail:n},e):this.active.has(s)&&this.end(s,e)}end(t,e){const n=this.active.get(t);n&&(n.alarm.until=e??n.alarm.t??0,this.active.delete(t))}see(t,e){const n=`${t.kind}:${t.seat}`,s=this.active.get(n);if(s){s.seen=e??s.seen,s.alarm.detail=t.detail||s.alarm.detail;return}const r={number:this.next++,...t,t:e,until:null};this.alarms.push(r),this.active.set(n,{alarm:r,seen:e??0}),this.alarms.length>Q1&&this.alarms.shift()}causes(t,e){const n=[],s=(r,o,a,l="")=>{n.push({kind:r,level:o,seat:a,detail:l})};if(t.stop){const r=t.stop.kind==="FAULT";s(r?"fault":"stopped",r||t.stop.kind==="STOP"?"alarm":"warning",t.stop.by,t.stop.why)}return t.shed>0&&s("shed","warning","",String(t.shed)),t.seats.forEach((r,o)=>{const a=e?.seats[o],l=a?.name??String(o+1);if(this.increased(`trips:${l}`,r.trips)&&s("trip","alarm",l,String(r.trips)),this.increased(`late:${l}`,r.late)&&s("late","warning",l,String(r.late)),r.taken===!0){if(r.heard===!1)return s("lost","alarm",l);xp(r.gate)==="red"&&s("gate","alarm",l,r.gate??""),Uh(r,a)&&s("clipping","warning",l),th(r)==="red"&&s("link","alarm",l),vp(r.margin_j)==="red"&&s("margin","warning",l),Mp(r.temperature_c)==="red"&&s("hot","alarm",l)}}),n}increased(t,e){if(e===null)return!1;const n=this.counts.get(t);return(this.counts.size<4*24||n!==void 0)&&this.counts.set(t,e),n!==void 0&&e>n}}const nw=.05;function cm(i,t,e){return i===null||t===null||!(Math.hypot(t[0]-i[0],t[1]-i[1],t[2]-i[2])<=nw)?t:[i[0]+(t[0]-i[0])*e,i[1]+(t[1]-i[1])*e,i[2]+(t[2]-i[2])*e]}function hm(i,t,e){return i===null||t===null?t:[i[0]+(t[0]-i[0])*e,i[1]+(t[1]-i[1])*e,i[2]+(t[2]-i[2])*e]}function iw(i,t,e){return i===void 0||i.person!==t.person?t:{...t,x:cm(i.x,t.x,e),f:hm(i.f,t.f,e)}}function sw(i,t,e){return i===void 0?t:{...t,x:cm(i.x,t.x,e),f:hm(i.f,t.f,e)}}function rw(i,t,e){return e>=1||i.seats.length!==t.seats.length||i.tools.length!==t.tools.length?t:{...t,t:i.t+(t.t-i.t)*e,seats:t.seats.map((n,s)=>iw(i.seats[s],n,e)),tools:t.tools.map((n,s)=>sw(i.tools[s],n,e))}}const ow=8,Td=1e3/60,aw=60,lw=1e-4,cw=500;class hw{constructor(){this.states=new yo(ow),this.offset=null,this.offsetAt=0,this.interval=Td,this.roundTrip=0,this.roundTripKnown=!1,this.skipped=0,this.received=0,this.drawn=-1}get newest(){return this.states.newest?.state??null}clear(){this.states.clear(),this.offset=null,this.interval=Td,this.drawn=-1}addRoundTrip(t){t>=0&&(this.roundTrip=this.roundTripKnown?Math.min(this.roundTrip,t):t,this.roundTripKnown=!0)}push(t,e){this.received+=1;const n=this.states.newest;n&&t.n<=n.state.n&&this.clear();const s=this.states.newest;s&&s.state.n>this.drawn&&(this.skipped+=1);const r=t.wall_us===null?e:t.wall_us/1e3,o=e-r;if(this.offset===null?this.offset=o:this.offset=Math.min(o,this.offset+Math.max(0,e-this.offsetAt)*lw),this.offsetAt=e,s){const a=r-s.wall_ms;a>0&&a<1e3&&(this.interval+=(a-this.interval)*.1)}this.states.push({state:t,wall_ms:r,received_ms:e})}sample(t){const e=this.states.newest;if(e===void 0||this.offset===null)return null;this.drawn=e.state.n;const n=t-this.offset,s=n-Math.min(aw,this.interval*1.2),[r,o]=this.stateAt(s,e),a=Math.max(0,t-e.received_ms);return{state:r,delay_ms:Math.max(0,n-o)+this.roundTrip/2,silence_ms:a,outOfDate:a>cw}}stateAt(t,e){if(t>=e.wall_ms)return[e.state,e.wall_ms];for(let s=this.states.length-1;s>0;s-=1){const r=this.states.at(s),o=this.states.at(s-1);if(!r||!o||o.wall_ms>t)continue;const a=r.wall_ms-o.wall_ms,l=a>0?(t-o.wall_ms)/a:1;return[rw(o.state,r.state,l),o.wall_ms+a*l]}const n=this.states.at(0)??e;return[n.state,n.wall_ms]}}const uw=500,fw=50;class dw{constructor(){this.link="connecting",this.hello=null,this.scene=null,this.notes=null,this.ownSeat=null,this.tickets=null,this.states=new hw,this.acknowledgements=new Im,this.alarms=new ew,this.history=new Vy,this.events=new yo(uw),this.notices=new yo(fw),this.revision=0}get state(){return this.states.newest}may(t){return this.link==="open"&&this.granted(t)}granted(t){return this.hello?.may.includes(t)??!1}apply(t,e){switch(t.type){case"hello":this.hello=t,this.revision+=1;break;case"scene":if(this.scene?.session!==t.session&&this.beginSession(),JSON.stringify(this.scene)===JSON.stringify(t))break;this.scene=t,this.revision+=1;break;case"state":this.states.push(t,e),this.acknowledgements.received(t.n,t.dropped),this.alarms.update(t,this.scene),this.history.update(t,this.scene);break;case"event":this.isRepeated(t)||this.events.push(t);break;case"notice":this.notices.push(t);break;case"seat":this.ownSeat=t.joined&&t.ended===null?t:null,t.ended!==null&&t.ended!=="left"&&this.notices.push({type:"notice",level:"error",text:`${t.seat}: ${t.ended}`});break;case"notes":this.notes=t,this.revision+=1;break;case"tickets":this.tickets=t,this.revision+=1;break}}connected(){this.link="open",this.states.clear(),this.acknowledgements.reset(),this.alarms.connection(!1,this.state?.t??null,"")}disconnected(t,e){this.link=t,this.ownSeat=null,this.alarms.connection(!0,this.state?.t??null,e)}beginSession(){this.states.clear(),this.history.clear(),this.events.clear(),this.notes=null,this.ownSeat=null}isRepeated(t){for(let e=this.events.length-1;e>=0;e-=1){const n=this.events.at(e);if(n?.session===t.session&&n.number===t.number&&n.text===t.text)return!0}return!1}}const um=document.getElementById("page");if(!um)throw new Error('index.html has no element "page"');const fm=new dw,dm=new sg(fm);new J1(fm,dm,um);dm.connect();
