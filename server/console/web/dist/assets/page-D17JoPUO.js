class Km{constructor(t=110){this.limit=t,this.sent=[]}take(t,e=0){return this.sent=this.sent.filter(n=>t-n<1e3),this.sent.length+e>=this.limit?!1:(this.sent.push(t),!0)}}class $m{constructor(){this.newest=0,this.acknowledged=0,this.dropped=0}received(t,e){t<this.newest&&(this.acknowledged=0),this.newest=t,this.dropped=e}get due(){return this.newest!==this.acknowledged}next(){return this.due?(this.acknowledged=this.newest,this.newest):null}reset(){this.newest=0,this.acknowledged=0,this.dropped=0}}const Zm=5e3,Jm=32;class Qm{constructor(){this.pending=new Map,this.next=1}get length(){return this.pending.size}add(t,e){if(this.pending.size>=Jm)return null;const n=this.next++;return this.pending.set(n,{sent_ms:t,done:e}),n}reply(t,e){const n=t.id===null?void 0:this.pending.get(t.id);return!n||t.id===null?!1:(this.pending.delete(t.id),n.done(t,e-n.sent_ms),!0)}expire(t,e){for(const[n,s]of this.pending)t-s.sent_ms>Zm&&this.fail(n,e)}failAll(t){for(const e of[...this.pending.keys()])this.fail(e,t)}fail(t,e){const n=this.pending.get(t);this.pending.delete(t),n?.done({type:"reply",id:t,ok:!1,text:e},NaN)}}class tg{constructor(){this.attempts=0}next(t){const e=Math.min(5e3,250*2**this.attempts);return this.attempts=Math.min(this.attempts+1,10),e*(.75+.5*t)}reset(){this.attempts=0}}const Ta=24,Gd=8,eg=1e3,ng=1<<20,ig=1e3,sg=["WAITING","RUNNING","STOPPED","PAUSED","OVER"],rg=["OSATS","GEARS","GOALS","CHECKLIST"],Jo=i=>typeof i=="object"&&i!==null&&!Array.isArray(i),bi=i=>Jo(i)?i:{},Gn=(i,t=ig)=>Array.isArray(i)?i.slice(0,t):[],Pe=i=>typeof i=="number"&&Number.isFinite(i)?i:null,Ar=i=>{const t=Pe(i);return t!==null&&t>=0?Math.floor(t):0},Rr=i=>typeof i=="boolean"?i:null,he=i=>typeof i=="string"?i.slice(0,eg).replace(/[\u0000-\u001f\u007f-\u009f\u200e\u200f\u202a-\u202e\u2066-\u2069]/g," "):"",ko=i=>typeof i=="string"?he(i):null,Ru=i=>Gn(i).filter(t=>typeof t=="string").map(he);function Us(i){const[t,e,n]=Gn(i,3).map(Pe);return t==null||e===void 0||e===null||n===void 0||n===null?null:[t,e,n]}function Ec(i){if(!Array.isArray(i))return null;const t=[];for(const e of Gn(i,Ta)){const n=Pe(e);if(n===null||n<0||n>1)return null;t.push(n)}return t}function Cu(i){const t=bi(i),e=Pe(t.at_m),n=t.axis;return e===null||n!==0&&n!==1&&n!==2?[]:[{axis:n,at_m:e,stiffness_n_m:Pe(t.stiffness_n_m),from_below:t.from_below===!0}]}function ag(i){const t=bi(i);return{name:he(t.name),kind:t.kind==="SLAVE"?"SLAVE":"MASTER",role:he(t.role),required:Rr(t.required),device:ko(t.device),force_limit_n:Pe(t.force_limit_n)}}function og(i){const t=bi(i);return{name:he(t.name),mass_kg:Pe(t.mass_kg),walls:Gn(t.walls,16).flatMap(Cu),tissues:Gn(t.tissues,16).flatMap(Cu)}}function lg(i){const t=bi(i);return{taken:Rr(t.taken),heard:Rr(t.heard),person:ko(t.person),engaged:Rr(t.engaged),gate:ko(t.gate),x:Us(t.x),f:Us(t.f),alpha:Ec(t.alpha)??[],rtt_ms:Pe(t.rtt_ms),loss_percent:Pe(t.loss_percent),gap_ms:Pe(t.gap_ms),age_ms:Pe(t.age_ms),margin_j:Pe(t.margin_j),trips:Pe(t.trips),late:Pe(t.late),temperature_c:Pe(t.temperature_c)}}function cg(i){const t=bi(i),e=Jo(t.transfer)?t.transfer:null;return{x:Us(t.x),v:Us(t.v),f:Us(t.f),depth_m:Pe(t.depth_m),touching:Rr(t.touching),wanted:Ec(t.wanted),applied:Ec(t.applied),transfer:e&&{by:he(e.by),to:he(e.to),alpha:Pe(e.alpha),ticks:Pe(e.ticks)}}}function hg(i){return Jo(i)?{number:Ar(i.number),kind:he(i.kind),by:he(i.by),why:he(i.why),yours:i.yours===!0}:null}function ug(i){const t=Pe(i.n);return t===null||t<0||!Number.isSafeInteger(t)?null:{type:"state",n:t,dropped:Ar(i.dropped),wall_us:Pe(i.wall_us),t:Pe(i.t)??0,phase:sg.find(e=>e===i.phase)??"WAITING",stop:hg(i.stop),version:Ar(i.version),shed:Ar(i.shed),held:he(i.held),seats:Gn(i.seats,Ta).map(lg),tools:Gn(i.tools,Gd).map(cg)}}function fg(i){const t=Object.create(null);for(const[e,n]of Object.entries(bi(i)).slice(0,64)){const s=Pe(n);s!==null&&(t[he(e)]=s)}return t}const Pu={state:ug,hello:i=>({type:"hello",protocol:Ar(i.protocol),release:he(i.release),person:he(i.person),role:he(i.role),may:Ru(i.may),sessions:Gn(i.sessions).map(bi).map(t=>({id:he(t.id),name:he(t.name),state:he(t.state)})),scenes:Ru(i.scenes)}),scene:i=>({type:"scene",session:he(i.session),name:he(i.name),tick_hz:Pe(i.tick_hz),dof:Pe(i.dof),law:ko(i.law),seats:Gn(i.seats,Ta).map(ag),tools:Gn(i.tools,Gd).map(og)}),event:i=>({type:"event",session:he(i.session),number:Ar(i.number),t:Pe(i.t),text:he(i.text)}),reply:i=>({type:"reply",id:Pe(i.id),ok:i.ok===!0,text:he(i.text)}),notice:i=>({type:"notice",level:i.level==="error"||i.level==="warning"?i.level:"info",text:he(i.text)}),seat:i=>({type:"seat",seat:he(i.seat),f:Us(i.f),x:Us(i.x),engaged:Rr(i.engaged),phase:he(i.phase)}),notes:i=>({type:"notes",marks:Gn(i.marks).map(bi).map(t=>({t:Pe(t.t),text:he(t.text),person:he(t.person)})),sheets:Gn(i.sheets).map(bi).flatMap(t=>{const e=rg.find(n=>n===t.sheet);return e===void 0?[]:[{sheet:e,of:he(t.of),person:he(t.person),scores:fg(t.scores),closed:t.closed===!0}]})}),tickets:i=>({type:"tickets",session:he(i.session),name:he(i.name),tickets:Gn(i.tickets,Ta*2).map(bi).map(t=>({person:he(t.person),role:he(t.role),seat:he(t.seat),ticket:he(t.ticket)}))})};function dg(i){if(i.length>ng)return null;let t;try{t=JSON.parse(i)}catch{return null}if(!Jo(t)||typeof t.type!="string")return null;const e=Object.prototype.hasOwnProperty.call(Pu,t.type)?Pu[t.type]:void 0;return e?e(t):null}const Vd={"language.name":"English","nav.label":"Views","nav.live":"Live","nav.instructor":"Instructor","nav.evaluator":"Evaluator","nav.seat":"Seat","nav.desk":"Lesson desk","nav.skip":"Skip to content","bar.session":"Session","bar.language":"Language","bar.theme":"Colours","theme.auto":"as the system","theme.light":"light","theme.dark":"dark","bar.sound":"Sound","bar.keys":"Keys","bar.keys_help":"Keys: S stops, P pauses, R resumes, M marks, 1 to 5 choose the view.","bar.person":"{person}, {role}","bar.settings":"Settings","link.connecting":"connecting","link.open":"connected","link.lost":"connection lost, trying again","link.refused":"no access","delay.value":"Delay {ms}","delay.old":"No new state for {s}","delay.none":"Waiting for the first state","delay.help":"Age of the picture: transport, waiting and interpolation. States not sent: {dropped}; not drawn: {skipped}.","phase.WAITING":"waiting","phase.RUNNING":"running","phase.STOPPED":"stopped","phase.PAUSED":"paused","phase.OVER":"over","role.INSTRUCTOR":"instructor","role.TRAINEE":"trainee","role.EVALUATOR":"evaluator","role.OBSERVER":"observer","role.OPERATOR":"operator","role.RECORDER":"recorder","join.title":"Join the session","join.explain":"This browser has no access yet. Type the ticket that you received, or open the link with it.","join.ticket":"Ticket","join.name":"Your name","join.go":"Join","join.failed":"The gateway could not be reached. Try again.","picture.label":"Picture of the session. Arrow keys turn the camera, plus and minus zoom.","picture.camera":"Camera","camera.free":"free","camera.front":"front","camera.above":"above","camera.seat":"at seat {seat}","picture.trails":"Trails of 3 s","picture.forces":"Forces","picture.names":"Names","picture.scale":"Arrow of 10 mm: {n} N","picture.none":"This browser has no WebGL. The table below shows the values.","picture.contact":"Contact","picture.limit":"force limit","picture.values":"Values","picture.legend":"Hands","values.what":"Object","values.position":"Position (mm)","values.force":"Force (N)","values.authority":"Authority","values.depth":"depth {mm}","stop.stop":"STOP","stop.pause":"Pause","stop.resume":"Resume","stop.drain":"Drain…","stop.remove":"Remove…","stop.active":"{kind} by {by}: {why}","stop.no_reason":"no reason given","stop.not_yours":"Only the person who stopped, or an instructor, may resume.","stop.kind.STOP":"Stop","stop.kind.PAUSE":"Pause","stop.kind.FAULT":"Fault","stop.why":"from the console","order.no_connection":"There is no connection to the gateway. The order was not sent.","order.unanswered":"No answer within 5 s. Look at the picture before you repeat the order.","order.too_many":"Too many orders at once. Repeat this one in a second.","order.not_allowed":"Your role does not allow this.","order.sent":"{what}: done","order.refused":"{what} was refused: {why}","who.title":"Who is here","who.seat":"Seat","who.person":"Person","who.role":"Role","who.device":"Device","who.state":"State","who.free":"free","who.lost":"lost","who.engaged":"engaged","who.released":"released","who.remove_title":"Remove the participant at seat {seat}","who.reason":"Reason","who.cancel":"Cancel","drain.title":"Drain the server","drain.explain":"All sessions end after the grace time. No new participant can join.","drain.grace":"Grace time (s)","authority.title":"Authority","authority.tool":"Tool {tool}","authority.wanted":"wanted","authority.applied":"applied","authority.share_of":"Authority of {seat}","authority.apply":"Apply","authority.reset":"Discard","authority.presets":"Presets","authority.demonstration":"Demonstration","authority.guidance":"Guidance","authority.evaluation":"Evaluation of {seat}","authority.hand_over":"Hand over to","authority.share":"Share","authority.give":"Hand over","authority.transfer":"{by} gives {alpha} to {to}. Begins in {ticks} ticks.","authority.no_transfer":"No transfer is announced.","authority.draft":"Not applied yet","authority.explain":"A transfer is announced for {ticks} ticks before it begins.","cards.title":"Seats","cards.quantity":"Last minute of","cards.gate":"Gate","cards.force":"Force","cards.of_limit":"{f} of {limit}","cards.rtt":"Round trip","cards.loss":"Loss","cards.gap":"Longest gap","cards.age":"Age","cards.margin":"Energy margin","cards.trips":"Trips","cards.late":"Late ticks","cards.temperature":"Temperature","cards.link":"Link quality","cards.spark":"{quantity} of {seat} in the last minute, now {value}","quantity.force":"force (N)","quantity.rtt":"round trip (ms)","quantity.loss":"loss (%)","quantity.margin":"energy margin (J)","band.green":"green: usable for stiff contact and fast motion","band.amber":"amber: usable for slow motion and soft contact","band.red":"red: outside the limits for force feedback","band.unknown":"no verdict","level.green":"good","level.amber":"attention","level.red":"beyond the limit","level.unknown":"unknown","gate.ON":"on","gate.OFF":"off","gate.RISING":"rising","gate.RELEASING":"releasing","gate.LATCHED":"latched off","gate.FAULT":"fault","alarms.title":"Alarms","alarms.none":"No alarm so far.","alarms.lasting":"lasting","alarms.until":"until {t}","alarm.stopped":"Session stopped by {seat}. {detail}","alarm.fault":"Fault: {seat}. {detail}","alarm.lost":"Seat {seat}: no data from the device.","alarm.gate":"Seat {seat}: the force is latched off.","alarm.clipping":"Seat {seat}: the force is at the limit of the device.","alarm.link":"Seat {seat}: link quality red.","alarm.margin":"Seat {seat}: no energy left, damping is added.","alarm.trip":"Seat {seat}: the safety gate tripped, {detail} in all.","alarm.late":"Seat {seat}: late ticks, {detail} in all.","alarm.hot":"Seat {seat}: the device is too hot.","alarm.shed":"The server sheds load, level {detail}.","alarm.connection":"No connection to the gateway. {detail}","events.title":"Events","events.none":"No event so far.","notices.title":"Messages","notices.dismiss":"Dismiss","marks.title":"Timeline","marks.note":"Note","marks.add":"Mark now","marks.at":"Mark at {t}","marks.none":"No mark so far.","marks.timeline":"Marks from the begin of the session to {t}","marks.placeholder":"what happened","sheet.title":"Sheets","sheet.kind":"Sheet","sheet.of":"Person at seat","sheet.OSATS":"OSATS, global rating","sheet.GEARS":"GEARS","sheet.GOALS":"GOALS","sheet.CHECKLIST":"Checklist","sheet.low":"1 = lowest, 5 = highest","sheet.done":"Tick what was done.","sheet.total":"Total {points} of {of}","sheet.missing":"{n} items without a score","sheet.optional":"optional","sheet.save":"Save draft","sheet.close":"Close sheet","sheet.closed":"This sheet is closed. It cannot be changed.","sheet.closed_as_draft":"Close is possible when all items have a score.","sheet.others":"Other evaluators","sheet.hidden":"Scores of other evaluators are shown after you closed your sheet.","sheet.no_others":"No other evaluator has closed this sheet.","item.respect_for_tissue":"Respect for tissue","item.time_and_motion":"Time and motion","item.instrument_handling":"Instrument handling","item.knowledge_of_instruments":"Knowledge of instruments","item.use_of_assistants":"Use of assistants","item.flow_and_forward_planning":"Flow of operation and forward planning","item.knowledge_of_procedure":"Knowledge of procedure","item.depth_perception":"Depth perception","item.bimanual_dexterity":"Bimanual dexterity","item.efficiency":"Efficiency","item.force_sensitivity":"Force sensitivity","item.robotic_control":"Robotic control","item.autonomy":"Autonomy","item.tissue_handling":"Tissue handling","item.device_checked":"Device checked before the task","item.task_explained":"Task explained and understood","item.contact_gentle":"First contact without impact","item.target_reached":"Target reached","item.no_force_limit":"Force limit never reached","item.hand_over_clear":"Hand-over announced and confirmed","seat.title":"Browser seat","seat.choose":"Free seat","seat.take":"Take seat","seat.leave":"Leave seat","seat.none_free":"No master seat is free.","seat.not_allowed":"The gateway or your role does not allow browser seats.","seat.yours":"You have seat {seat}.","seat.pad":"Pad of the hand. Hold and drag, or use the arrow keys; space holds and releases.","seat.plane":"Pad shows","seat.front":"right and up","seat.above":"right and away","seat.depth_front":"Away from you (mm)","seat.depth_above":"Up (mm)","seat.hold":"Hold","seat.held":"Your hand holds the device.","seat.released":"Your hand is released. Press on the pad to hold the device.","seat.force":"Force on your hand","seat.gamepad":"Gamepad: left stick right and up, right stick away, first button holds.","seat.gamepad_on":"Gamepad connected.","seat.intended":"intended","seat.actual":"actual","seat.explain":"The dashed circle is where you want the hand, the filled one is where it is. The line between both is the force.","desk.title":"New session","desk.scene":"Scene","desk.name":"Name of the session","desk.people":"People","desk.person":"Name of person {n}","desk.role":"Role of person {n}","desk.seat":"Seat of person {n} (empty without seat)","desk.add":"Add person","desk.drop":"Remove person {n}","desk.create":"Create session","desk.start":"Start","desk.end":"End session","desk.tickets":"Tickets of session {name}","desk.ticket_of":"Ticket of {person}","desk.single_use":"Each ticket works once. Give each link to its person only.","desk.link":"Link for the browser","desk.step1":"Install the client: apt install tandem-client.","desk.step2":"Connect the device and look at it: tandem-client doctor.","desk.step3":"Join with the ticket: tandem-client join --server SERVER --ticket-file FILE --seat {seat}.","desk.steps":"With a real device","desk.print":"Print","desk.qr":"QR code of the link for {person}"},pg={"language.name":"Français","nav.label":"Vues","nav.live":"Direct","nav.instructor":"Instructeur","nav.evaluator":"Évaluateur","nav.seat":"Poste","nav.desk":"Préparation","nav.skip":"Aller au contenu","bar.session":"Session","bar.language":"Langue","bar.theme":"Couleurs","theme.auto":"comme le système","theme.light":"clair","theme.dark":"sombre","bar.sound":"Son","bar.keys":"Touches","bar.keys_help":"Touches : S arrête, P met en pause, R reprend, M marque, 1 à 5 choisissent la vue.","bar.person":"{person}, {role}","bar.settings":"Réglages","link.connecting":"connexion en cours","link.open":"connecté","link.lost":"connexion perdue, nouvel essai","link.refused":"pas d’accès","delay.value":"Retard {ms}","delay.old":"Aucun état depuis {s}","delay.none":"En attente du premier état","delay.help":"Âge de l’image : transport, attente et interpolation. États non envoyés : {dropped} ; non dessinés : {skipped}.","phase.WAITING":"en attente","phase.RUNNING":"en cours","phase.STOPPED":"arrêtée","phase.PAUSED":"en pause","phase.OVER":"terminée","role.INSTRUCTOR":"instructeur","role.TRAINEE":"apprenant","role.EVALUATOR":"évaluateur","role.OBSERVER":"observateur","role.OPERATOR":"opérateur","role.RECORDER":"enregistreur","join.title":"Rejoindre la session","join.explain":"Ce navigateur n’a pas encore d’accès. Saisissez le billet que vous avez reçu, ou ouvrez son lien.","join.ticket":"Billet","join.name":"Votre nom","join.go":"Rejoindre","join.failed":"La passerelle est injoignable. Réessayez.","picture.label":"Image de la session. Les flèches tournent la caméra, plus et moins changent le zoom.","picture.camera":"Caméra","camera.free":"libre","camera.front":"de face","camera.above":"de dessus","camera.seat":"au poste {seat}","picture.trails":"Traces de 3 s","picture.forces":"Forces","picture.names":"Noms","picture.scale":"Flèche de 10 mm : {n} N","picture.none":"Ce navigateur n’a pas WebGL. Le tableau ci-dessous montre les valeurs.","picture.contact":"Contact","picture.limit":"limite de force","picture.values":"Valeurs","picture.legend":"Mains","values.what":"Objet","values.position":"Position (mm)","values.force":"Force (N)","values.authority":"Autorité","values.depth":"profondeur {mm}","stop.stop":"ARRÊT","stop.pause":"Pause","stop.resume":"Reprendre","stop.drain":"Vider…","stop.remove":"Retirer…","stop.active":"{kind} par {by} : {why}","stop.no_reason":"sans raison donnée","stop.not_yours":"Seul l’auteur de l’arrêt, ou un instructeur, peut reprendre.","stop.kind.STOP":"Arrêt","stop.kind.PAUSE":"Pause","stop.kind.FAULT":"Défaut","stop.why":"depuis la console","order.no_connection":"Pas de connexion avec la passerelle. L’ordre n’est pas parti.","order.unanswered":"Pas de réponse en 5 s. Regardez l’image avant de répéter l’ordre.","order.too_many":"Trop d’ordres à la fois. Répétez celui-ci dans une seconde.","order.not_allowed":"Votre rôle ne le permet pas.","order.sent":"{what} : fait","order.refused":"{what}, refusé : {why}","who.title":"Personnes présentes","who.seat":"Poste","who.person":"Personne","who.role":"Rôle","who.device":"Appareil","who.state":"État","who.free":"libre","who.lost":"perdu","who.engaged":"engagé","who.released":"relâché","who.remove_title":"Retirer la personne du poste {seat}","who.reason":"Raison","who.cancel":"Annuler","drain.title":"Vider le serveur","drain.explain":"Toutes les sessions finissent après le délai. Personne ne peut plus entrer.","drain.grace":"Délai (s)","authority.title":"Autorité","authority.tool":"Outil {tool}","authority.wanted":"voulue","authority.applied":"appliquée","authority.share_of":"Autorité de {seat}","authority.apply":"Appliquer","authority.reset":"Abandonner","authority.presets":"Préréglages","authority.demonstration":"Démonstration","authority.guidance":"Guidage","authority.evaluation":"Évaluation de {seat}","authority.hand_over":"Donner la main à","authority.share":"Part","authority.give":"Donner la main","authority.transfer":"{by} donne {alpha} à {to}. Début dans {ticks} pas.","authority.no_transfer":"Aucun transfert annoncé.","authority.draft":"Pas encore appliqué","authority.explain":"Un transfert est annoncé {ticks} pas avant son début.","cards.title":"Postes","cards.quantity":"Dernière minute de","cards.gate":"Porte de force","cards.force":"Force","cards.of_limit":"{f} sur {limit}","cards.rtt":"Aller-retour","cards.loss":"Pertes","cards.gap":"Plus long trou","cards.age":"Âge","cards.margin":"Marge d’énergie","cards.trips":"Coupures","cards.late":"Pas en retard","cards.temperature":"Température","cards.link":"Qualité du lien","cards.spark":"{quantity} de {seat} dans la dernière minute, maintenant {value}","quantity.force":"force (N)","quantity.rtt":"aller-retour (ms)","quantity.loss":"pertes (%)","quantity.margin":"marge d’énergie (J)","band.green":"vert : convient au contact raide et au mouvement rapide","band.amber":"orange : convient au mouvement lent et au contact doux","band.red":"rouge : hors des limites du retour d’effort","band.unknown":"pas de verdict","level.green":"bon","level.amber":"attention","level.red":"hors limite","level.unknown":"inconnu","gate.ON":"ouverte","gate.OFF":"fermée","gate.RISING":"en montée","gate.RELEASING":"en descente","gate.LATCHED":"verrouillée","gate.FAULT":"défaut","alarms.title":"Alarmes","alarms.none":"Aucune alarme.","alarms.lasting":"en cours","alarms.until":"jusqu’à {t}","alarm.stopped":"Session arrêtée par {seat}. {detail}","alarm.fault":"Défaut : {seat}. {detail}","alarm.lost":"Poste {seat} : pas de données de l’appareil.","alarm.gate":"Poste {seat} : la force est verrouillée.","alarm.clipping":"Poste {seat} : la force atteint la limite de l’appareil.","alarm.link":"Poste {seat} : lien rouge.","alarm.margin":"Poste {seat} : plus d’énergie, de l’amortissement s’ajoute.","alarm.trip":"Poste {seat} : la sécurité a coupé, {detail} en tout.","alarm.late":"Poste {seat} : pas en retard, {detail} en tout.","alarm.hot":"Poste {seat} : l’appareil est trop chaud.","alarm.shed":"Le serveur réduit la charge, niveau {detail}.","alarm.connection":"Pas de connexion avec la passerelle. {detail}","events.title":"Événements","events.none":"Aucun événement.","notices.title":"Messages","notices.dismiss":"Fermer","marks.title":"Chronologie","marks.note":"Note","marks.add":"Marquer maintenant","marks.at":"Marquer à {t}","marks.none":"Aucune marque.","marks.timeline":"Marques du début de la session à {t}","marks.placeholder":"ce qui s’est passé","sheet.title":"Fiches","sheet.kind":"Fiche","sheet.of":"Personne au poste","sheet.OSATS":"OSATS, évaluation globale","sheet.GEARS":"GEARS","sheet.GOALS":"GOALS","sheet.CHECKLIST":"Liste de contrôle","sheet.low":"1 = le plus bas, 5 = le plus haut","sheet.done":"Cochez ce qui a été fait.","sheet.total":"Total {points} sur {of}","sheet.missing":"{n} points sans note","sheet.optional":"facultatif","sheet.save":"Garder le brouillon","sheet.close":"Clore la fiche","sheet.closed":"Cette fiche est close. Elle ne peut plus changer.","sheet.closed_as_draft":"La fiche peut être close quand tous les points ont une note.","sheet.others":"Autres évaluateurs","sheet.hidden":"Les notes des autres évaluateurs apparaissent après la clôture de votre fiche.","sheet.no_others":"Aucun autre évaluateur n’a clos cette fiche.","item.respect_for_tissue":"Respect des tissus","item.time_and_motion":"Temps et mouvements","item.instrument_handling":"Maniement des instruments","item.knowledge_of_instruments":"Connaissance des instruments","item.use_of_assistants":"Usage des assistants","item.flow_and_forward_planning":"Déroulement et anticipation","item.knowledge_of_procedure":"Connaissance de la procédure","item.depth_perception":"Perception de la profondeur","item.bimanual_dexterity":"Dextérité des deux mains","item.efficiency":"Efficacité","item.force_sensitivity":"Sensibilité à la force","item.robotic_control":"Contrôle du robot","item.autonomy":"Autonomie","item.tissue_handling":"Traitement des tissus","item.device_checked":"Appareil vérifié avant la tâche","item.task_explained":"Tâche expliquée et comprise","item.contact_gentle":"Premier contact sans choc","item.target_reached":"Cible atteinte","item.no_force_limit":"Limite de force jamais atteinte","item.hand_over_clear":"Transfert annoncé et confirmé","seat.title":"Poste du navigateur","seat.choose":"Poste libre","seat.take":"Prendre le poste","seat.leave":"Quitter le poste","seat.none_free":"Aucun poste maître n’est libre.","seat.not_allowed":"La passerelle ou votre rôle ne permet pas de poste dans le navigateur.","seat.yours":"Vous avez le poste {seat}.","seat.pad":"Surface de la main. Tenez et tirez, ou utilisez les flèches ; espace tient et relâche.","seat.plane":"La surface montre","seat.front":"droite et haut","seat.above":"droite et avant","seat.depth_front":"Vers l’avant (mm)","seat.depth_above":"Vers le haut (mm)","seat.hold":"Tenir","seat.held":"Votre main tient l’appareil.","seat.released":"Votre main est relâchée. Appuyez sur la surface pour tenir l’appareil.","seat.force":"Force sur votre main","seat.gamepad":"Manette : stick gauche droite et haut, stick droit avant, premier bouton tient.","seat.gamepad_on":"Manette connectée.","seat.intended":"voulue","seat.actual":"réelle","seat.explain":"Le cercle en tirets est la position voulue, le cercle plein la position réelle. Le trait entre les deux est la force.","desk.title":"Nouvelle session","desk.scene":"Scène","desk.name":"Nom de la session","desk.people":"Personnes","desk.person":"Nom de la personne {n}","desk.role":"Rôle de la personne {n}","desk.seat":"Poste de la personne {n} (vide sans poste)","desk.add":"Ajouter une personne","desk.drop":"Retirer la personne {n}","desk.create":"Créer la session","desk.start":"Démarrer","desk.end":"Terminer la session","desk.tickets":"Billets de la session {name}","desk.ticket_of":"Billet de {person}","desk.single_use":"Chaque billet sert une fois. Donnez chaque lien à sa personne seulement.","desk.link":"Lien pour le navigateur","desk.step1":"Installer le client : apt install tandem-client.","desk.step2":"Brancher l’appareil et le vérifier : tandem-client doctor.","desk.step3":"Entrer avec le billet : tandem-client join --server SERVEUR --ticket-file FICHIER --seat {seat}.","desk.steps":"Avec un vrai appareil","desk.print":"Imprimer","desk.qr":"Code QR du lien pour {person}"},Th={en:Vd,fr:pg};let Ah="en";function Oo(i){Ah=i}function mg(){return Ah}function gg(i){for(const t of i){const e=Object.keys(Th).find(n=>t.toLowerCase().split("-")[0]===n);if(e)return e}return"en"}function H(i,t={}){return Th[Ah][i].replace(/\{(\w+)\}/g,(e,n)=>Object.prototype.hasOwnProperty.call(t,n)?String(t[n]):e)}function hs(i,t){if(t===null||t==="")return"–";const e=`${i}.${t}`;return Object.prototype.hasOwnProperty.call(Vd,e)?H(e):t}const Lu=10;class _g{constructor(t){this.model=t,this.socket=null,this.pending=new Qm,this.backoff=new tg,this.budget=new Km,this.onChange=()=>{},setInterval(()=>{this.pending.expire(performance.now(),H("order.unanswered")),document.hidden&&this.acknowledge()},250),window.addEventListener("online",()=>this.connect())}connect(){if(clearTimeout(this.retry),this.socket&&this.socket.readyState<=WebSocket.OPEN)return;const t=new WebSocket(`${location.protocol==="https:"?"wss":"ws"}://${location.host}/live`);this.socket=t;let e=!1;t.onopen=()=>{e=!0,this.backoff.reset(),this.model.connected(),this.onChange()},t.onmessage=({data:n})=>{typeof n=="string"&&this.onFrame(n)},t.onclose=({code:n,reason:s})=>void this.onClose(t,e,n,s)}reconnect(){this.backoff.reset();const t=this.socket;this.socket=null,t?.close(),this.connect()}request(t){return new Promise(e=>{const n=r=>e({type:"reply",id:null,ok:!1,text:r});if(this.socket?.readyState!==WebSocket.OPEN)return n(H("order.no_connection"));if(!this.budget.take(performance.now()))return n(H("order.too_many"));const s=this.pending.add(performance.now(),(r,a)=>{t.type==="watch"&&this.model.states.addRoundTrip(a),e(r)});if(s===null)return n(H("order.too_many"));this.socket.send(JSON.stringify({...t,id:s}))})}signal(t){this.socket?.readyState!==WebSocket.OPEN||!this.budget.take(performance.now(),Lu)||this.socket.send(JSON.stringify(t))}acknowledge(){if(this.socket?.readyState!==WebSocket.OPEN||!this.model.acknowledgements.due||!this.budget.take(performance.now(),Lu))return;const t=this.model.acknowledgements.next();t!==null&&this.socket.send(JSON.stringify({type:"ack",n:t}))}onFrame(t){const e=dg(t);if(!e)return;const n=performance.now(),s=this.model.scene?.session;this.model.apply(e,n),e.type==="reply"&&!this.pending.reply(e,n)&&!e.ok&&this.model.apply({type:"notice",level:"error",text:e.text},n),e.type==="hello"&&this.watchAgain(s),e.type!=="state"&&e.type!=="seat"&&this.onChange()}watchAgain(t){const e=this.model.hello?.sessions??[],n=e.find(({id:s})=>s===t)??e[0];n&&this.request({type:"watch",session:n.id})}async onClose(t,e,n,s){if(this.socket!==t)return;this.socket=null,this.pending.failAll(H("order.no_connection"));const r=s||`WebSocket ${n}`;this.model.disconnected(!e&&await vg()?"refused":"lost",r),this.onChange(),this.model.link==="lost"&&(this.retry=setTimeout(()=>this.connect(),this.backoff.next(Math.random())))}}async function vg(){try{return(await fetch("/healthz",{cache:"no-store"})).ok}catch{return!1}}const xg=/^[A-Za-z0-9_-]{1,32}$/,Mg=["INSTRUCTOR","TRAINEE","EVALUATOR","OBSERVER"];function Ga(i){return xg.test(i)}function yg(i){const t=[];Ga(i.scene)||t.push({field:"scene",index:null}),Ga(i.name)||t.push({field:"name",index:null}),i.people.length>2*Ta&&t.push({field:"people",index:null});const e=new Set,n=new Set;return i.people.forEach((s,r)=>{(!Ga(s.name)||e.has(s.name))&&t.push({field:"person",index:r}),s.seat!==""&&(!Ga(s.seat)||n.has(s.seat))&&t.push({field:"seat",index:r}),e.add(s.name),s.seat!==""&&n.add(s.seat)}),t}function Sg(i,t){return`${i}/#ticket=${encodeURIComponent(t.ticket)}&name=${encodeURIComponent(t.person)}`}function Eg(i){const t=new URLSearchParams(i.replace(/^#/,"")),e=t.get("ticket");return e?{ticket:e.slice(0,4096),name:(t.get("name")??"").slice(0,64)}:null}function z(i,t={},...e){const n=document.createElement(i);return Wd(n,t),n.append(...e.filter(s=>s!==null)),n}function Ei(i,t={},...e){const n=document.createElementNS("http://www.w3.org/2000/svg",i);return Wd(n,t),n.append(...e.filter(s=>s!==null)),n}function Wd(i,t){for(const[e,n]of Object.entries(t))typeof n=="function"?i.addEventListener(e.slice(2),n):n===!0?i.setAttribute(e,""):n!==!1&&n!==void 0&&i.setAttribute(e,String(n))}function Ae(i,t){i.textContent!==t&&(i.textContent=t)}function as(i,t,e){i.getAttribute(t)!==e&&(e===null?i.removeAttribute(t):i.setAttribute(t,e))}function be(i,t){i.disabled!==t&&(i.disabled=t)}function Ye(i,t){return z("label",{class:"field"},z("span",{},i),t)}function ii(i,t,e){const n=z("select",{onchange:()=>e(n.value)});return ks(n,i,t),n}function ks(i,t,e){i.replaceChildren(...t.map(([n,s])=>z("option",{value:n},s))),t.some(([n])=>n===e)&&(i.value=e)}function He(i,t,e={}){return z("button",{type:"button",onclick:t,...e},i)}function wc(i,t,e){const n=z("input",{type:"checkbox",onchange:()=>e(n.checked)});return n.checked=t,z("label",{class:"check"},n,z("span",{},i))}function qn(i,t,...e){const n=z("h2",{id:`${t}-title`},i);return z("section",{class:`panel ${t}`,"aria-labelledby":n.id},n,...e)}function Du(i,t,e,n,s,r){return new Promise(a=>{const o=z("button",{type:"submit",value:"go",class:"danger"},s),l=z("h2",{id:"dialog-title"},i),c=z("dialog",{"aria-labelledby":l.id,onclose:()=>{c.remove(),a(c.returnValue==="go"?e.value:null)}},z("form",{method:"dialog"},l,t?z("p",{},t):null,Ye(n,e),z("div",{class:"row"},o,z("button",{type:"submit",value:"cancel",formnovalidate:!0},r))));document.body.append(c),c.showModal()})}class wg{constructor(t){this.page=t,this.active=z("p",{class:"active-stop",role:"status"}),this.stop=He(H("stop.stop"),()=>this.order("stop"),{class:"stop","aria-keyshortcuts":"S"}),this.pause=He(H("stop.pause"),()=>this.order("pause"),{class:"pause","aria-keyshortcuts":"P"}),this.resume=He(H("stop.resume"),()=>this.order("resume"),{class:"resume","aria-keyshortcuts":"R"}),this.node=z("div",{class:"control-bar"},this.stop,this.pause,this.resume,this.active)}order(t){const{model:e}=this.page,n=H(`stop.${t}`);if(!e.granted(t)){this.page.report("warning",H("order.refused",{what:n,why:H("order.not_allowed")}));return}const s=e.state?.stop;if(t==="resume"&&!s)return;const r=t==="resume"?{order:t,stop:s?.number??0}:{order:t,why:H("stop.why")};this.page.order(n,r)}update(){const{model:t}=this.page,e=t.state,n=["stop","pause","resume"].some(o=>t.granted(o)),s=e?.stop??null;this.node.hidden=!n&&!s;for(const[o,l]of[[this.stop,"stop"],[this.pause,"pause"],[this.resume,"resume"]])o.hidden=!t.granted(l);const r=e?.phase==="OVER";be(this.stop,!t.may("stop")||r||s?.kind==="STOP"),be(this.pause,!t.may("pause")||r||s!==null),be(this.resume,!t.may("resume")||s===null||!s.yours),this.node.classList.toggle("stopped",s!==null);const a=s?H("stop.active",{kind:hs("stop.kind",s.kind),by:s.by||"–",why:s.why||H("stop.no_reason")})+(s.yours||!t.granted("resume")?"":` ${H("stop.not_yours")}`):"";Ae(this.active,a),this.active.hidden=a===""}}function bg(i){return i&&i.__esModule&&Object.prototype.hasOwnProperty.call(i,"default")?i.default:i}var Xd={exports:{}};(function(i,t){var e=function(){var n=function(D,A){var y=236,P=17,O=D,g=r[A],m=null,E=0,N=null,F=[],B={},G=function(Z,J){E=O*4+17,m=function(Y){for(var at=new Array(Y),ot=0;ot<Y;ot+=1){at[ot]=new Array(Y);for(var I=0;I<Y;I+=1)at[ot][I]=null}return at}(E),$(0,0),$(E-7,0),$(0,E-7),ct(),dt(),xt(Z,J),O>=7&&gt(Z),N==null&&(N=pt(O,g,F)),Vt(N,J)},$=function(Z,J){for(var Y=-1;Y<=7;Y+=1)if(!(Z+Y<=-1||E<=Z+Y))for(var at=-1;at<=7;at+=1)J+at<=-1||E<=J+at||(0<=Y&&Y<=6&&(at==0||at==6)||0<=at&&at<=6&&(Y==0||Y==6)||2<=Y&&Y<=4&&2<=at&&at<=4?m[Z+Y][J+at]=!0:m[Z+Y][J+at]=!1)},Q=function(){for(var Z=0,J=0,Y=0;Y<8;Y+=1){G(!0,Y);var at=o.getLostPoint(B);(Y==0||Z>at)&&(Z=at,J=Y)}return J},dt=function(){for(var Z=8;Z<E-8;Z+=1)m[Z][6]==null&&(m[Z][6]=Z%2==0);for(var J=8;J<E-8;J+=1)m[6][J]==null&&(m[6][J]=J%2==0)},ct=function(){for(var Z=o.getPatternPosition(O),J=0;J<Z.length;J+=1)for(var Y=0;Y<Z.length;Y+=1){var at=Z[J],ot=Z[Y];if(m[at][ot]==null)for(var I=-2;I<=2;I+=1)for(var Ot=-2;Ot<=2;Ot+=1)I==-2||I==2||Ot==-2||Ot==2||I==0&&Ot==0?m[at+I][ot+Ot]=!0:m[at+I][ot+Ot]=!1}},gt=function(Z){for(var J=o.getBCHTypeNumber(O),Y=0;Y<18;Y+=1){var at=!Z&&(J>>Y&1)==1;m[Math.floor(Y/3)][Y%3+E-8-3]=at}for(var Y=0;Y<18;Y+=1){var at=!Z&&(J>>Y&1)==1;m[Y%3+E-8-3][Math.floor(Y/3)]=at}},xt=function(Z,J){for(var Y=g<<3|J,at=o.getBCHTypeInfo(Y),ot=0;ot<15;ot+=1){var I=!Z&&(at>>ot&1)==1;ot<6?m[ot][8]=I:ot<8?m[ot+1][8]=I:m[E-15+ot][8]=I}for(var ot=0;ot<15;ot+=1){var I=!Z&&(at>>ot&1)==1;ot<8?m[8][E-ot-1]=I:ot<9?m[8][15-ot-1+1]=I:m[8][15-ot-1]=I}m[E-8][8]=!Z},Vt=function(Z,J){for(var Y=-1,at=E-1,ot=7,I=0,Ot=o.getMaskFunction(J),Mt=E-1;Mt>0;Mt-=2)for(Mt==6&&(Mt-=1);;){for(var Ht=0;Ht<2;Ht+=1)if(m[at][Mt-Ht]==null){var At=!1;I<Z.length&&(At=(Z[I]>>>ot&1)==1);var Et=Ot(at,Mt-Ht);Et&&(At=!At),m[at][Mt-Ht]=At,ot-=1,ot==-1&&(I+=1,ot=7)}if(at+=Y,at<0||E<=at){at-=Y,Y=-Y;break}}},rt=function(Z,J){for(var Y=0,at=0,ot=0,I=new Array(J.length),Ot=new Array(J.length),Mt=0;Mt<J.length;Mt+=1){var Ht=J[Mt].dataCount,At=J[Mt].totalCount-Ht;at=Math.max(at,Ht),ot=Math.max(ot,At),I[Mt]=new Array(Ht);for(var Et=0;Et<I[Mt].length;Et+=1)I[Mt][Et]=255&Z.getBuffer()[Et+Y];Y+=Ht;var Xt=o.getErrorCorrectPolynomial(At),L=c(I[Mt],Xt.getLength()-1),w=L.mod(Xt);Ot[Mt]=new Array(Xt.getLength()-1);for(var Et=0;Et<Ot[Mt].length;Et+=1){var V=Et+w.getLength()-Ot[Mt].length;Ot[Mt][Et]=V>=0?w.getAt(V):0}}for(var it=0,Et=0;Et<J.length;Et+=1)it+=J[Et].totalCount;for(var ht=new Array(it),nt=0,Et=0;Et<at;Et+=1)for(var Mt=0;Mt<J.length;Mt+=1)Et<I[Mt].length&&(ht[nt]=I[Mt][Et],nt+=1);for(var Et=0;Et<ot;Et+=1)for(var Mt=0;Mt<J.length;Mt+=1)Et<Ot[Mt].length&&(ht[nt]=Ot[Mt][Et],nt+=1);return ht},pt=function(Z,J,Y){for(var at=u.getRSBlocks(Z,J),ot=f(),I=0;I<Y.length;I+=1){var Ot=Y[I];ot.put(Ot.getMode(),4),ot.put(Ot.getLength(),o.getLengthInBits(Ot.getMode(),Z)),Ot.write(ot)}for(var Mt=0,I=0;I<at.length;I+=1)Mt+=at[I].dataCount;if(ot.getLengthInBits()>Mt*8)throw"code length overflow. ("+ot.getLengthInBits()+">"+Mt*8+")";for(ot.getLengthInBits()+4<=Mt*8&&ot.put(0,4);ot.getLengthInBits()%8!=0;)ot.putBit(!1);for(;!(ot.getLengthInBits()>=Mt*8||(ot.put(y,8),ot.getLengthInBits()>=Mt*8));)ot.put(P,8);return rt(ot,at)};B.addData=function(Z,J){J=J||"Byte";var Y=null;switch(J){case"Numeric":Y=h(Z);break;case"Alphanumeric":Y=_(Z);break;case"Byte":Y=x(Z);break;case"Kanji":Y=M(Z);break;default:throw"mode:"+J}F.push(Y),N=null},B.isDark=function(Z,J){if(Z<0||E<=Z||J<0||E<=J)throw Z+","+J;return m[Z][J]},B.getModuleCount=function(){return E},B.make=function(){if(O<1){for(var Z=1;Z<40;Z++){for(var J=u.getRSBlocks(Z,g),Y=f(),at=0;at<F.length;at++){var ot=F[at];Y.put(ot.getMode(),4),Y.put(ot.getLength(),o.getLengthInBits(ot.getMode(),Z)),ot.write(Y)}for(var I=0,at=0;at<J.length;at++)I+=J[at].dataCount;if(Y.getLengthInBits()<=I*8)break}O=Z}G(!1,Q())},B.createTableTag=function(Z,J){Z=Z||2,J=typeof J>"u"?Z*4:J;var Y="";Y+='<table style="',Y+=" border-width: 0px; border-style: none;",Y+=" border-collapse: collapse;",Y+=" padding: 0px; margin: "+J+"px;",Y+='">',Y+="<tbody>";for(var at=0;at<B.getModuleCount();at+=1){Y+="<tr>";for(var ot=0;ot<B.getModuleCount();ot+=1)Y+='<td style="',Y+=" border-width: 0px; border-style: none;",Y+=" border-collapse: collapse;",Y+=" padding: 0px; margin: 0px;",Y+=" width: "+Z+"px;",Y+=" height: "+Z+"px;",Y+=" background-color: ",Y+=B.isDark(at,ot)?"#000000":"#ffffff",Y+=";",Y+='"/>';Y+="</tr>"}return Y+="</tbody>",Y+="</table>",Y},B.createSvgTag=function(Z,J,Y,at){var ot={};typeof arguments[0]=="object"&&(ot=arguments[0],Z=ot.cellSize,J=ot.margin,Y=ot.alt,at=ot.title),Z=Z||2,J=typeof J>"u"?Z*4:J,Y=typeof Y=="string"?{text:Y}:Y||{},Y.text=Y.text||null,Y.id=Y.text?Y.id||"qrcode-description":null,at=typeof at=="string"?{text:at}:at||{},at.text=at.text||null,at.id=at.text?at.id||"qrcode-title":null;var I=B.getModuleCount()*Z+J*2,Ot,Mt,Ht,At,Et="",Xt;for(Xt="l"+Z+",0 0,"+Z+" -"+Z+",0 0,-"+Z+"z ",Et+='<svg version="1.1" xmlns="http://www.w3.org/2000/svg"',Et+=ot.scalable?"":' width="'+I+'px" height="'+I+'px"',Et+=' viewBox="0 0 '+I+" "+I+'" ',Et+=' preserveAspectRatio="xMinYMin meet"',Et+=at.text||Y.text?' role="img" aria-labelledby="'+Dt([at.id,Y.id].join(" ").trim())+'"':"",Et+=">",Et+=at.text?'<title id="'+Dt(at.id)+'">'+Dt(at.text)+"</title>":"",Et+=Y.text?'<description id="'+Dt(Y.id)+'">'+Dt(Y.text)+"</description>":"",Et+='<rect width="100%" height="100%" fill="white" cx="0" cy="0"/>',Et+='<path d="',Ht=0;Ht<B.getModuleCount();Ht+=1)for(At=Ht*Z+J,Ot=0;Ot<B.getModuleCount();Ot+=1)B.isDark(Ht,Ot)&&(Mt=Ot*Z+J,Et+="M"+Mt+","+At+Xt);return Et+='" stroke="transparent" fill="black"/>',Et+="</svg>",Et},B.createDataURL=function(Z,J){Z=Z||2,J=typeof J>"u"?Z*4:J;var Y=B.getModuleCount()*Z+J*2,at=J,ot=Y-J;return R(Y,Y,function(I,Ot){if(at<=I&&I<ot&&at<=Ot&&Ot<ot){var Mt=Math.floor((I-at)/Z),Ht=Math.floor((Ot-at)/Z);return B.isDark(Ht,Mt)?0:1}else return 1})},B.createImgTag=function(Z,J,Y){Z=Z||2,J=typeof J>"u"?Z*4:J;var at=B.getModuleCount()*Z+J*2,ot="";return ot+="<img",ot+=' src="',ot+=B.createDataURL(Z,J),ot+='"',ot+=' width="',ot+=at,ot+='"',ot+=' height="',ot+=at,ot+='"',Y&&(ot+=' alt="',ot+=Dt(Y),ot+='"'),ot+="/>",ot};var Dt=function(Z){for(var J="",Y=0;Y<Z.length;Y+=1){var at=Z.charAt(Y);switch(at){case"<":J+="&lt;";break;case">":J+="&gt;";break;case"&":J+="&amp;";break;case'"':J+="&quot;";break;default:J+=at;break}}return J},St=function(Z){var J=1;Z=typeof Z>"u"?J*2:Z;var Y=B.getModuleCount()*J+Z*2,at=Z,ot=Y-Z,I,Ot,Mt,Ht,At,Et={"██":"█","█ ":"▀"," █":"▄","  ":" "},Xt={"██":"▀","█ ":"▀"," █":" ","  ":" "},L="";for(I=0;I<Y;I+=2){for(Mt=Math.floor((I-at)/J),Ht=Math.floor((I+1-at)/J),Ot=0;Ot<Y;Ot+=1)At="█",at<=Ot&&Ot<ot&&at<=I&&I<ot&&B.isDark(Mt,Math.floor((Ot-at)/J))&&(At=" "),at<=Ot&&Ot<ot&&at<=I+1&&I+1<ot&&B.isDark(Ht,Math.floor((Ot-at)/J))?At+=" ":At+="█",L+=Z<1&&I+1>=ot?Xt[At]:Et[At];L+=`
`}return Y%2&&Z>0?L.substring(0,L.length-Y-1)+Array(Y+1).join("▀"):L.substring(0,L.length-1)};return B.createASCII=function(Z,J){if(Z=Z||1,Z<2)return St(J);Z-=1,J=typeof J>"u"?Z*2:J;var Y=B.getModuleCount()*Z+J*2,at=J,ot=Y-J,I,Ot,Mt,Ht,At=Array(Z+1).join("██"),Et=Array(Z+1).join("  "),Xt="",L="";for(I=0;I<Y;I+=1){for(Mt=Math.floor((I-at)/Z),L="",Ot=0;Ot<Y;Ot+=1)Ht=1,at<=Ot&&Ot<ot&&at<=I&&I<ot&&B.isDark(Mt,Math.floor((Ot-at)/Z))&&(Ht=0),L+=Ht?At:Et;for(Mt=0;Mt<Z;Mt+=1)Xt+=L+`
`}return Xt.substring(0,Xt.length-1)},B.renderTo2dContext=function(Z,J){J=J||2;for(var Y=B.getModuleCount(),at=0;at<Y;at++)for(var ot=0;ot<Y;ot++)Z.fillStyle=B.isDark(at,ot)?"black":"white",Z.fillRect(at*J,ot*J,J,J)},B};n.stringToBytesFuncs={default:function(D){for(var A=[],y=0;y<D.length;y+=1){var P=D.charCodeAt(y);A.push(P&255)}return A}},n.stringToBytes=n.stringToBytesFuncs.default,n.createStringToBytes=function(D,A){var y=function(){for(var O=C(D),g=function(){var dt=O.read();if(dt==-1)throw"eof";return dt},m=0,E={};;){var N=O.read();if(N==-1)break;var F=g(),B=g(),G=g(),$=String.fromCharCode(N<<8|F),Q=B<<8|G;E[$]=Q,m+=1}if(m!=A)throw m+" != "+A;return E}(),P=63;return function(O){for(var g=[],m=0;m<O.length;m+=1){var E=O.charCodeAt(m);if(E<128)g.push(E);else{var N=y[O.charAt(m)];typeof N=="number"?(N&255)==N?g.push(N):(g.push(N>>>8),g.push(N&255)):g.push(P)}}return g}};var s={MODE_NUMBER:1,MODE_ALPHA_NUM:2,MODE_8BIT_BYTE:4,MODE_KANJI:8},r={L:1,M:0,Q:3,H:2},a={PATTERN000:0,PATTERN001:1,PATTERN010:2,PATTERN011:3,PATTERN100:4,PATTERN101:5,PATTERN110:6,PATTERN111:7},o=function(){var D=[[],[6,18],[6,22],[6,26],[6,30],[6,34],[6,22,38],[6,24,42],[6,26,46],[6,28,50],[6,30,54],[6,32,58],[6,34,62],[6,26,46,66],[6,26,48,70],[6,26,50,74],[6,30,54,78],[6,30,56,82],[6,30,58,86],[6,34,62,90],[6,28,50,72,94],[6,26,50,74,98],[6,30,54,78,102],[6,28,54,80,106],[6,32,58,84,110],[6,30,58,86,114],[6,34,62,90,118],[6,26,50,74,98,122],[6,30,54,78,102,126],[6,26,52,78,104,130],[6,30,56,82,108,134],[6,34,60,86,112,138],[6,30,58,86,114,142],[6,34,62,90,118,146],[6,30,54,78,102,126,150],[6,24,50,76,102,128,154],[6,28,54,80,106,132,158],[6,32,58,84,110,136,162],[6,26,54,82,110,138,166],[6,30,58,86,114,142,170]],A=1335,y=7973,P=21522,O={},g=function(m){for(var E=0;m!=0;)E+=1,m>>>=1;return E};return O.getBCHTypeInfo=function(m){for(var E=m<<10;g(E)-g(A)>=0;)E^=A<<g(E)-g(A);return(m<<10|E)^P},O.getBCHTypeNumber=function(m){for(var E=m<<12;g(E)-g(y)>=0;)E^=y<<g(E)-g(y);return m<<12|E},O.getPatternPosition=function(m){return D[m-1]},O.getMaskFunction=function(m){switch(m){case a.PATTERN000:return function(E,N){return(E+N)%2==0};case a.PATTERN001:return function(E,N){return E%2==0};case a.PATTERN010:return function(E,N){return N%3==0};case a.PATTERN011:return function(E,N){return(E+N)%3==0};case a.PATTERN100:return function(E,N){return(Math.floor(E/2)+Math.floor(N/3))%2==0};case a.PATTERN101:return function(E,N){return E*N%2+E*N%3==0};case a.PATTERN110:return function(E,N){return(E*N%2+E*N%3)%2==0};case a.PATTERN111:return function(E,N){return(E*N%3+(E+N)%2)%2==0};default:throw"bad maskPattern:"+m}},O.getErrorCorrectPolynomial=function(m){for(var E=c([1],0),N=0;N<m;N+=1)E=E.multiply(c([1,l.gexp(N)],0));return E},O.getLengthInBits=function(m,E){if(1<=E&&E<10)switch(m){case s.MODE_NUMBER:return 10;case s.MODE_ALPHA_NUM:return 9;case s.MODE_8BIT_BYTE:return 8;case s.MODE_KANJI:return 8;default:throw"mode:"+m}else if(E<27)switch(m){case s.MODE_NUMBER:return 12;case s.MODE_ALPHA_NUM:return 11;case s.MODE_8BIT_BYTE:return 16;case s.MODE_KANJI:return 10;default:throw"mode:"+m}else if(E<41)switch(m){case s.MODE_NUMBER:return 14;case s.MODE_ALPHA_NUM:return 13;case s.MODE_8BIT_BYTE:return 16;case s.MODE_KANJI:return 12;default:throw"mode:"+m}else throw"type:"+E},O.getLostPoint=function(m){for(var E=m.getModuleCount(),N=0,F=0;F<E;F+=1)for(var B=0;B<E;B+=1){for(var G=0,$=m.isDark(F,B),Q=-1;Q<=1;Q+=1)if(!(F+Q<0||E<=F+Q))for(var dt=-1;dt<=1;dt+=1)B+dt<0||E<=B+dt||Q==0&&dt==0||$==m.isDark(F+Q,B+dt)&&(G+=1);G>5&&(N+=3+G-5)}for(var F=0;F<E-1;F+=1)for(var B=0;B<E-1;B+=1){var ct=0;m.isDark(F,B)&&(ct+=1),m.isDark(F+1,B)&&(ct+=1),m.isDark(F,B+1)&&(ct+=1),m.isDark(F+1,B+1)&&(ct+=1),(ct==0||ct==4)&&(N+=3)}for(var F=0;F<E;F+=1)for(var B=0;B<E-6;B+=1)m.isDark(F,B)&&!m.isDark(F,B+1)&&m.isDark(F,B+2)&&m.isDark(F,B+3)&&m.isDark(F,B+4)&&!m.isDark(F,B+5)&&m.isDark(F,B+6)&&(N+=40);for(var B=0;B<E;B+=1)for(var F=0;F<E-6;F+=1)m.isDark(F,B)&&!m.isDark(F+1,B)&&m.isDark(F+2,B)&&m.isDark(F+3,B)&&m.isDark(F+4,B)&&!m.isDark(F+5,B)&&m.isDark(F+6,B)&&(N+=40);for(var gt=0,B=0;B<E;B+=1)for(var F=0;F<E;F+=1)m.isDark(F,B)&&(gt+=1);var xt=Math.abs(100*gt/E/E-50)/5;return N+=xt*10,N},O}(),l=function(){for(var D=new Array(256),A=new Array(256),y=0;y<8;y+=1)D[y]=1<<y;for(var y=8;y<256;y+=1)D[y]=D[y-4]^D[y-5]^D[y-6]^D[y-8];for(var y=0;y<255;y+=1)A[D[y]]=y;var P={};return P.glog=function(O){if(O<1)throw"glog("+O+")";return A[O]},P.gexp=function(O){for(;O<0;)O+=255;for(;O>=256;)O-=255;return D[O]},P}();function c(D,A){if(typeof D.length>"u")throw D.length+"/"+A;var y=function(){for(var O=0;O<D.length&&D[O]==0;)O+=1;for(var g=new Array(D.length-O+A),m=0;m<D.length-O;m+=1)g[m]=D[m+O];return g}(),P={};return P.getAt=function(O){return y[O]},P.getLength=function(){return y.length},P.multiply=function(O){for(var g=new Array(P.getLength()+O.getLength()-1),m=0;m<P.getLength();m+=1)for(var E=0;E<O.getLength();E+=1)g[m+E]^=l.gexp(l.glog(P.getAt(m))+l.glog(O.getAt(E)));return c(g,0)},P.mod=function(O){if(P.getLength()-O.getLength()<0)return P;for(var g=l.glog(P.getAt(0))-l.glog(O.getAt(0)),m=new Array(P.getLength()),E=0;E<P.getLength();E+=1)m[E]=P.getAt(E);for(var E=0;E<O.getLength();E+=1)m[E]^=l.gexp(l.glog(O.getAt(E))+g);return c(m,0).mod(O)},P}var u=function(){var D=[[1,26,19],[1,26,16],[1,26,13],[1,26,9],[1,44,34],[1,44,28],[1,44,22],[1,44,16],[1,70,55],[1,70,44],[2,35,17],[2,35,13],[1,100,80],[2,50,32],[2,50,24],[4,25,9],[1,134,108],[2,67,43],[2,33,15,2,34,16],[2,33,11,2,34,12],[2,86,68],[4,43,27],[4,43,19],[4,43,15],[2,98,78],[4,49,31],[2,32,14,4,33,15],[4,39,13,1,40,14],[2,121,97],[2,60,38,2,61,39],[4,40,18,2,41,19],[4,40,14,2,41,15],[2,146,116],[3,58,36,2,59,37],[4,36,16,4,37,17],[4,36,12,4,37,13],[2,86,68,2,87,69],[4,69,43,1,70,44],[6,43,19,2,44,20],[6,43,15,2,44,16],[4,101,81],[1,80,50,4,81,51],[4,50,22,4,51,23],[3,36,12,8,37,13],[2,116,92,2,117,93],[6,58,36,2,59,37],[4,46,20,6,47,21],[7,42,14,4,43,15],[4,133,107],[8,59,37,1,60,38],[8,44,20,4,45,21],[12,33,11,4,34,12],[3,145,115,1,146,116],[4,64,40,5,65,41],[11,36,16,5,37,17],[11,36,12,5,37,13],[5,109,87,1,110,88],[5,65,41,5,66,42],[5,54,24,7,55,25],[11,36,12,7,37,13],[5,122,98,1,123,99],[7,73,45,3,74,46],[15,43,19,2,44,20],[3,45,15,13,46,16],[1,135,107,5,136,108],[10,74,46,1,75,47],[1,50,22,15,51,23],[2,42,14,17,43,15],[5,150,120,1,151,121],[9,69,43,4,70,44],[17,50,22,1,51,23],[2,42,14,19,43,15],[3,141,113,4,142,114],[3,70,44,11,71,45],[17,47,21,4,48,22],[9,39,13,16,40,14],[3,135,107,5,136,108],[3,67,41,13,68,42],[15,54,24,5,55,25],[15,43,15,10,44,16],[4,144,116,4,145,117],[17,68,42],[17,50,22,6,51,23],[19,46,16,6,47,17],[2,139,111,7,140,112],[17,74,46],[7,54,24,16,55,25],[34,37,13],[4,151,121,5,152,122],[4,75,47,14,76,48],[11,54,24,14,55,25],[16,45,15,14,46,16],[6,147,117,4,148,118],[6,73,45,14,74,46],[11,54,24,16,55,25],[30,46,16,2,47,17],[8,132,106,4,133,107],[8,75,47,13,76,48],[7,54,24,22,55,25],[22,45,15,13,46,16],[10,142,114,2,143,115],[19,74,46,4,75,47],[28,50,22,6,51,23],[33,46,16,4,47,17],[8,152,122,4,153,123],[22,73,45,3,74,46],[8,53,23,26,54,24],[12,45,15,28,46,16],[3,147,117,10,148,118],[3,73,45,23,74,46],[4,54,24,31,55,25],[11,45,15,31,46,16],[7,146,116,7,147,117],[21,73,45,7,74,46],[1,53,23,37,54,24],[19,45,15,26,46,16],[5,145,115,10,146,116],[19,75,47,10,76,48],[15,54,24,25,55,25],[23,45,15,25,46,16],[13,145,115,3,146,116],[2,74,46,29,75,47],[42,54,24,1,55,25],[23,45,15,28,46,16],[17,145,115],[10,74,46,23,75,47],[10,54,24,35,55,25],[19,45,15,35,46,16],[17,145,115,1,146,116],[14,74,46,21,75,47],[29,54,24,19,55,25],[11,45,15,46,46,16],[13,145,115,6,146,116],[14,74,46,23,75,47],[44,54,24,7,55,25],[59,46,16,1,47,17],[12,151,121,7,152,122],[12,75,47,26,76,48],[39,54,24,14,55,25],[22,45,15,41,46,16],[6,151,121,14,152,122],[6,75,47,34,76,48],[46,54,24,10,55,25],[2,45,15,64,46,16],[17,152,122,4,153,123],[29,74,46,14,75,47],[49,54,24,10,55,25],[24,45,15,46,46,16],[4,152,122,18,153,123],[13,74,46,32,75,47],[48,54,24,14,55,25],[42,45,15,32,46,16],[20,147,117,4,148,118],[40,75,47,7,76,48],[43,54,24,22,55,25],[10,45,15,67,46,16],[19,148,118,6,149,119],[18,75,47,31,76,48],[34,54,24,34,55,25],[20,45,15,61,46,16]],A=function(O,g){var m={};return m.totalCount=O,m.dataCount=g,m},y={},P=function(O,g){switch(g){case r.L:return D[(O-1)*4+0];case r.M:return D[(O-1)*4+1];case r.Q:return D[(O-1)*4+2];case r.H:return D[(O-1)*4+3];default:return}};return y.getRSBlocks=function(O,g){var m=P(O,g);if(typeof m>"u")throw"bad rs block @ typeNumber:"+O+"/errorCorrectionLevel:"+g;for(var E=m.length/3,N=[],F=0;F<E;F+=1)for(var B=m[F*3+0],G=m[F*3+1],$=m[F*3+2],Q=0;Q<B;Q+=1)N.push(A(G,$));return N},y}(),f=function(){var D=[],A=0,y={};return y.getBuffer=function(){return D},y.getAt=function(P){var O=Math.floor(P/8);return(D[O]>>>7-P%8&1)==1},y.put=function(P,O){for(var g=0;g<O;g+=1)y.putBit((P>>>O-g-1&1)==1)},y.getLengthInBits=function(){return A},y.putBit=function(P){var O=Math.floor(A/8);D.length<=O&&D.push(0),P&&(D[O]|=128>>>A%8),A+=1},y},h=function(D){var A=s.MODE_NUMBER,y=D,P={};P.getMode=function(){return A},P.getLength=function(m){return y.length},P.write=function(m){for(var E=y,N=0;N+2<E.length;)m.put(O(E.substring(N,N+3)),10),N+=3;N<E.length&&(E.length-N==1?m.put(O(E.substring(N,N+1)),4):E.length-N==2&&m.put(O(E.substring(N,N+2)),7))};var O=function(m){for(var E=0,N=0;N<m.length;N+=1)E=E*10+g(m.charAt(N));return E},g=function(m){if("0"<=m&&m<="9")return m.charCodeAt(0)-48;throw"illegal char :"+m};return P},_=function(D){var A=s.MODE_ALPHA_NUM,y=D,P={};P.getMode=function(){return A},P.getLength=function(g){return y.length},P.write=function(g){for(var m=y,E=0;E+1<m.length;)g.put(O(m.charAt(E))*45+O(m.charAt(E+1)),11),E+=2;E<m.length&&g.put(O(m.charAt(E)),6)};var O=function(g){if("0"<=g&&g<="9")return g.charCodeAt(0)-48;if("A"<=g&&g<="Z")return g.charCodeAt(0)-65+10;switch(g){case" ":return 36;case"$":return 37;case"%":return 38;case"*":return 39;case"+":return 40;case"-":return 41;case".":return 42;case"/":return 43;case":":return 44;default:throw"illegal char :"+g}};return P},x=function(D){var A=s.MODE_8BIT_BYTE,y=n.stringToBytes(D),P={};return P.getMode=function(){return A},P.getLength=function(O){return y.length},P.write=function(O){for(var g=0;g<y.length;g+=1)O.put(y[g],8)},P},M=function(D){var A=s.MODE_KANJI,y=n.stringToBytesFuncs.SJIS;if(!y)throw"sjis not supported.";(function(g,m){var E=y(g);if(E.length!=2||(E[0]<<8|E[1])!=m)throw"sjis not supported."})("友",38726);var P=y(D),O={};return O.getMode=function(){return A},O.getLength=function(g){return~~(P.length/2)},O.write=function(g){for(var m=P,E=0;E+1<m.length;){var N=(255&m[E])<<8|255&m[E+1];if(33088<=N&&N<=40956)N-=33088;else if(57408<=N&&N<=60351)N-=49472;else throw"illegal char at "+(E+1)+"/"+N;N=(N>>>8&255)*192+(N&255),g.put(N,13),E+=2}if(E<m.length)throw"illegal char at "+(E+1)},O},p=function(){var D=[],A={};return A.writeByte=function(y){D.push(y&255)},A.writeShort=function(y){A.writeByte(y),A.writeByte(y>>>8)},A.writeBytes=function(y,P,O){P=P||0,O=O||y.length;for(var g=0;g<O;g+=1)A.writeByte(y[g+P])},A.writeString=function(y){for(var P=0;P<y.length;P+=1)A.writeByte(y.charCodeAt(P))},A.toByteArray=function(){return D},A.toString=function(){var y="";y+="[";for(var P=0;P<D.length;P+=1)P>0&&(y+=","),y+=D[P];return y+="]",y},A},d=function(){var D=0,A=0,y=0,P="",O={},g=function(E){P+=String.fromCharCode(m(E&63))},m=function(E){if(!(E<0)){if(E<26)return 65+E;if(E<52)return 97+(E-26);if(E<62)return 48+(E-52);if(E==62)return 43;if(E==63)return 47}throw"n:"+E};return O.writeByte=function(E){for(D=D<<8|E&255,A+=8,y+=1;A>=6;)g(D>>>A-6),A-=6},O.flush=function(){if(A>0&&(g(D<<6-A),D=0,A=0),y%3!=0)for(var E=3-y%3,N=0;N<E;N+=1)P+="="},O.toString=function(){return P},O},C=function(D){var A=D,y=0,P=0,O=0,g={};g.read=function(){for(;O<8;){if(y>=A.length){if(O==0)return-1;throw"unexpected end of file./"+O}var E=A.charAt(y);if(y+=1,E=="=")return O=0,-1;if(E.match(/^\s$/))continue;P=P<<6|m(E.charCodeAt(0)),O+=6}var N=P>>>O-8&255;return O-=8,N};var m=function(E){if(65<=E&&E<=90)return E-65;if(97<=E&&E<=122)return E-97+26;if(48<=E&&E<=57)return E-48+52;if(E==43)return 62;if(E==47)return 63;throw"c:"+E};return g},b=function(D,A){var y=D,P=A,O=new Array(D*A),g={};g.setPixel=function(F,B,G){O[B*y+F]=G},g.write=function(F){F.writeString("GIF87a"),F.writeShort(y),F.writeShort(P),F.writeByte(128),F.writeByte(0),F.writeByte(0),F.writeByte(0),F.writeByte(0),F.writeByte(0),F.writeByte(255),F.writeByte(255),F.writeByte(255),F.writeString(","),F.writeShort(0),F.writeShort(0),F.writeShort(y),F.writeShort(P),F.writeByte(0);var B=2,G=E(B);F.writeByte(B);for(var $=0;G.length-$>255;)F.writeByte(255),F.writeBytes(G,$,255),$+=255;F.writeByte(G.length-$),F.writeBytes(G,$,G.length-$),F.writeByte(0),F.writeString(";")};var m=function(F){var B=F,G=0,$=0,Q={};return Q.write=function(dt,ct){if(dt>>>ct)throw"length over";for(;G+ct>=8;)B.writeByte(255&(dt<<G|$)),ct-=8-G,dt>>>=8-G,$=0,G=0;$=dt<<G|$,G=G+ct},Q.flush=function(){G>0&&B.writeByte($)},Q},E=function(F){for(var B=1<<F,G=(1<<F)+1,$=F+1,Q=N(),dt=0;dt<B;dt+=1)Q.add(String.fromCharCode(dt));Q.add(String.fromCharCode(B)),Q.add(String.fromCharCode(G));var ct=p(),gt=m(ct);gt.write(B,$);var xt=0,Vt=String.fromCharCode(O[xt]);for(xt+=1;xt<O.length;){var rt=String.fromCharCode(O[xt]);xt+=1,Q.contains(Vt+rt)?Vt=Vt+rt:(gt.write(Q.indexOf(Vt),$),Q.size()<4095&&(Q.size()==1<<$&&($+=1),Q.add(Vt+rt)),Vt=rt)}return gt.write(Q.indexOf(Vt),$),gt.write(G,$),gt.flush(),ct.toByteArray()},N=function(){var F={},B=0,G={};return G.add=function($){if(G.contains($))throw"dup key:"+$;F[$]=B,B+=1},G.size=function(){return B},G.indexOf=function($){return F[$]},G.contains=function($){return typeof F[$]<"u"},G};return g},R=function(D,A,y){for(var P=b(D,A),O=0;O<A;O+=1)for(var g=0;g<D;g+=1)P.setPixel(g,O,y(g,O));var m=p();P.write(m);for(var E=d(),N=m.toByteArray(),F=0;F<N.length;F+=1)E.writeByte(N[F]);return E.flush(),"data:image/gif;base64,"+E};return n}();(function(){e.stringToBytesFuncs["UTF-8"]=function(n){function s(r){for(var a=[],o=0;o<r.length;o++){var l=r.charCodeAt(o);l<128?a.push(l):l<2048?a.push(192|l>>6,128|l&63):l<55296||l>=57344?a.push(224|l>>12,128|l>>6&63,128|l&63):(o++,l=65536+((l&1023)<<10|r.charCodeAt(o)&1023),a.push(240|l>>18,128|l>>12&63,128|l>>6&63,128|l&63))}return a}return s(n)}})(),function(n){i.exports=n()}(function(){return e})})(Xd);var Tg=Xd.exports;const Ag=bg(Tg),Tl=4;function Rg(i,t){const e=Ag(0,"M");e.addData(i,"Byte"),e.make();const n=e.getModuleCount();let s="";for(let a=0;a<n;a+=1)for(let o=0;o<n;o+=1)e.isDark(a,o)&&(s+=`M${o+Tl} ${a+Tl}h1v1h-1z`);const r=n+2*Tl;return Ei("svg",{class:"qr",viewBox:`0 0 ${r} ${r}`,role:"img","aria-label":t},Ei("rect",{width:r,height:r,fill:"#ffffff"}),Ei("path",{d:s,fill:"#000000"}))}class Cg{constructor(t){this.page=t,this.scenes=z("datalist",{id:"scenes"}),this.name=z("input",{type:"text",maxlength:32,pattern:"[A-Za-z0-9_\\-]{1,32}",required:!0}),this.people=z("div",{class:"people"}),this.create=z("button",{type:"submit",class:"primary"},H("desk.create")),this.tickets=z("div",{class:"tickets"}),this.rows=[],this.known=null,this.revision=-1,this.scene=z("input",{type:"text",maxlength:32,list:"scenes",pattern:"[A-Za-z0-9_\\-]{1,32}",required:!0}),this.start=He(H("desk.start"),()=>this.order("start")),this.end=He(H("desk.end"),()=>this.order("end"),{class:"danger"});const e=z("form",{onsubmit:n=>{n.preventDefault(),this.send()}},z("div",{class:"row"},Ye(H("desk.scene"),this.scene),this.scenes,Ye(H("desk.name"),this.name)),z("h3",{},H("desk.people")),this.people,z("div",{class:"row"},He(H("desk.add"),()=>this.add("TRAINEE","")),this.create));this.node=z("div",{class:"view desk-view"},qn(H("desk.title"),"desk-panel",e,z("div",{class:"row"},this.start,this.end)),this.tickets),this.add("INSTRUCTOR","trainer"),this.add("TRAINEE","trainee")}update(){const{model:t}=this.page,e=t.may("create");be(this.create,!e),be(this.start,!e||!this.session()),be(this.end,!e||!this.session()),t.revision!==this.revision&&(this.revision=t.revision,this.scenes.replaceChildren(...(t.hello?.scenes??[]).map(n=>z("option",{value:n})))),t.tickets!==this.known&&(this.known=t.tickets,this.showTickets())}session(){return this.page.model.tickets?.session??this.page.model.scene?.session}order(t){const e=this.session();e&&this.page.order(H(`desk.${t}`),{order:t,session:e})}add(t,e){const n=this.rows.length+1,s=z("input",{type:"text",maxlength:32,pattern:"[A-Za-z0-9_\\-]{1,32}",required:!0}),r=z("input",{type:"text",maxlength:32,pattern:"[A-Za-z0-9_\\-]{0,32}"});r.value=e;const a=ii(Mg.map(u=>[u,hs("role",u)]),t,()=>{}),o=He("✕",()=>this.drop(c),{"aria-label":H("desk.drop",{n}),class:"quiet"}),l=z("div",{class:"row person"},Ye(H("desk.person",{n}),s),Ye(H("desk.role",{n}),a),Ye(H("desk.seat",{n}),r),o),c={node:l,name:s,role:a,seat:r};this.rows.push(c),this.people.append(l)}drop(t){this.rows=this.rows.filter(e=>e!==t),t.node.remove()}send(){const t={scene:this.scene.value.trim(),name:this.name.value.trim(),people:this.rows.map(n=>({name:n.name.value.trim(),role:n.role.value,seat:n.seat.value.trim()}))},e=yg(t)[0];if(e){const n=e.index===null?void 0:this.rows[e.index],s=e.field==="scene"?this.scene:e.field==="seat"?n?.seat:n?.name??this.name;s?.focus();const r=s?.closest("label")?.textContent??H("desk.people");this.page.report("error",`${r}: A-Z a-z 0-9 _ -, 1…32`);return}this.page.order(H("desk.create"),{order:"create",...t})}showTickets(){const t=this.known;if(!t)return this.tickets.replaceChildren();const e=t.tickets.map(n=>{const s=Sg(location.origin,n),r=[H("desk.step1"),H("desk.step2"),H("desk.step3",{seat:n.seat||"SEAT"})];return z("article",{class:"ticket","aria-label":H("desk.ticket_of",{person:n.person})},z("h3",{},n.person," ",z("small",{},[hs("role",n.role),n.seat].filter(Boolean).join(", "))),Rg(s,H("desk.qr",{person:n.person})),z("p",{},z("a",{href:s},H("desk.link"))),z("h4",{},H("desk.steps")),z("ol",{},...r.map(a=>z("li",{},a))),z("p",{class:"note"},H("desk.ticket_of",{person:n.person}),": ",z("code",{},n.ticket)))});this.tickets.replaceChildren(qn(H("desk.tickets",{name:t.name}),"tickets-panel",z("p",{class:"note"},H("desk.single_use")),z("div",{class:"row no-print"},He(H("desk.print"),()=>window.print())),z("div",{class:"ticket-grid"},...e)))}}const Ti="–";function nn(i,t,e=""){if(i==null||!Number.isFinite(i))return Ti;const n=i.toFixed(t),s=Number(n)===0?0 .toFixed(t):n;return e?`${s} ${e}`:s}function Er(i){return nn(i==null?null:i*100,0,"%")}function ss(i){if(i==null||!Number.isFinite(i))return Ti;const t=Math.max(0,Math.floor(i*10+1e-6)),e=Math.floor(t/10),n=o=>String(o).padStart(2,"0"),[s,r,a]=[Math.floor(e/3600),Math.floor(e/60)%60,e%60];return s>0?`${s}:${n(r)}:${n(a)}`:`${r}:${n(a)}.${t%10}`}const Iu=40;function Pg(i){return H(`alarm.${i.kind}`,{seat:i.seat||"–",detail:i.detail}).trim()}function Uu(i,t,e,n){return z("li",{class:i},z("time",{},t),z("span",{},e),z("small",{},n))}class qd{constructor(t){this.page=t,this.alarms=z("ol",{class:"log"}),this.events=z("ol",{class:"log"}),this.rendered="";const e=(n,s)=>z("div",{class:"scroll log-box",tabindex:0,role:"region","aria-label":n},s);this.node=z("div",{class:"logs"},qn(H("alarms.title"),"alarms-panel",e(H("alarms.title"),this.alarms)),qn(H("events.title"),"events-panel",e(H("events.title"),this.events)))}update(){const{model:t}=this.page,e=t.alarms.list().slice(0,Iu),n=t.events.toArray().slice(-Iu).reverse(),s=JSON.stringify([e.map(r=>[r.number,r.until,r.detail]),n.map(r=>r.number)]);s!==this.rendered&&(this.rendered=s,this.alarms.replaceChildren(...e.length>0?e.map(r=>Uu(`${r.level}${r.until===null?" lasting":""}`,ss(r.t),Pg(r),r.until===null?H("alarms.lasting"):H("alarms.until",{t:ss(r.until)}))):[z("li",{class:"empty"},H("alarms.none"))]),this.events.replaceChildren(...n.length>0?n.map(r=>Uu("event",ss(r.t),r.text,"")):[z("li",{class:"empty"},H("events.none"))]))}}const Lg=50;function Yd(i){return i?.seats.filter(t=>t.kind==="MASTER")??[]}const Fo=i=>i>=0?Math.min(1,i):0;function Nu(i){const t=i.map(Fo),e=t.reduce((a,o)=>a+o,0);if(t.length===0)return[];const n=e>0?t.map(a=>a/e):t.map(()=>1/t.length),s=1-n.reduce((a,o)=>a+o,0),r=n.indexOf(Math.max(...n));return n.map((a,o)=>o===r?Fo(a+s):a)}function ku(i,t,e){if(t<0||t>=i.length)return Nu(i);if(i.length===1)return[1];const n=Fo(e),s=i.map((o,l)=>l===t?0:Fo(o)),r=s.reduce((o,l)=>o+l,0),a=s.map((o,l)=>l===t?n:r>0?o/r*(1-n):(1-n)/(i.length-1));return Nu(a)}function jd(i,t){return Array.from({length:i},(e,n)=>n===t?1:0)}function Rh(i){return Math.max(0,i.findIndex(t=>t.role==="INSTRUCTOR"))}function Bo(i){const t=i.map((n,s)=>s),e=t.filter(n=>i[n]?.role==="TRAINEE");return e.length>0?e:t.filter(n=>n!==Rh(i))}function Dg(i){const t=Rh(i),e=Bo(i).filter(n=>n!==t);return e.length===0?jd(i.length,t):i.map((n,s)=>s===t?.5:e.includes(s)?.5/e.length:0)}function Ig(i,t){return i===null||t===null||i.length!==t.length?!1:i.every((e,n)=>Math.abs(e-(t[n]??0))<.005)}const Kd=[{name:"OSATS",range:[1,5],items:[{id:"respect_for_tissue"},{id:"time_and_motion"},{id:"instrument_handling"},{id:"knowledge_of_instruments"},{id:"use_of_assistants"},{id:"flow_and_forward_planning"},{id:"knowledge_of_procedure"}]},{name:"GEARS",range:[1,5],items:[{id:"depth_perception"},{id:"bimanual_dexterity"},{id:"efficiency"},{id:"force_sensitivity"},{id:"robotic_control"},{id:"autonomy",optional:!0}]},{name:"GOALS",range:[1,5],items:[{id:"depth_perception"},{id:"bimanual_dexterity"},{id:"efficiency"},{id:"tissue_handling"},{id:"autonomy"}]},{name:"CHECKLIST",range:[0,1],items:[{id:"device_checked"},{id:"task_explained"},{id:"contact_gentle"},{id:"target_reached"},{id:"no_force_limit"},{id:"hand_over_clear"}]}];function ra(i){const t=Kd.find(e=>e.name===i);if(!t)throw new RangeError(`sheet ${i}: allowed are OSATS, GEARS, GOALS and CHECKLIST`);return t}function bc(i,t){const e={};for(const{id:n}of i.items){const s=Object.prototype.hasOwnProperty.call(t,n)?t[n]:void 0;s!==void 0&&Number.isInteger(s)&&s>=i.range[0]&&s<=i.range[1]&&(e[n]=s)}return e}function Ou(i,t){const e=bc(i,t),n=Object.values(e);return{points:n.reduce((s,r)=>s+r,0),of:n.length*i.range[1],missing:i.items.filter(s=>!s.optional&&e[s.id]===void 0).map(s=>s.id)}}function $d(i,t,e,n){return i?.sheets.find(s=>s.person===t&&s.sheet===e&&s.of===n)??null}function Ug(i,t,e,n){return $d(i,t,e,n)?.closed?i?.sheets.filter(s=>s.person!==t&&s.sheet===e&&s.of===n&&s.closed)??[]:[]}const Al=i=>H(`item.${i}`);class Ng{constructor(t){this.page=t,this.of=ii([],"",()=>this.open()),this.items=z("div",{class:"items"}),this.total=z("p",{class:"total",role:"status"}),this.note=z("p",{class:"note"}),this.others=z("div",{class:"others"}),this.name="OSATS",this.scores={},this.closed=!1,this.drafts=new Map,this.knownScene=null,this.knownNotes=null;const e=ii(Kd.map(n=>[n.name,H(`sheet.${n.name}`)]),this.name,n=>{this.name=n,this.open()});this.save=He(H("sheet.save"),()=>this.send(!1)),this.close=He(H("sheet.close"),()=>this.send(!0),{class:"primary"}),this.node=qn(H("sheet.title"),"sheet-panel",z("div",{class:"row"},Ye(H("sheet.kind"),e),Ye(H("sheet.of"),this.of)),this.items,z("div",{class:"row"},this.total,this.save,this.close),this.note,z("h3",{},H("sheet.others")),this.others)}update(){const{model:t}=this.page;if(t.scene&&t.scene!==this.knownScene){this.knownScene=t.scene;const l=Yd(t.scene),c=l[Bo(l)[0]??0]?.name??"";ks(this.of,l.map(u=>[u.name,u.name]),this.of.value||c),this.of.value||(this.of.value=c),this.open()}t.notes!==this.knownNotes&&(this.knownNotes=t.notes,this.open());const e=ra(this.name),n=Ou(e,this.scores),s=n.missing.length,r=e.name==="CHECKLIST"||s===0?"":` · ${H("sheet.missing",{n:s})}`,a=e.name==="CHECKLIST"?e.items.length:n.of;Ae(this.total,H("sheet.total",{points:n.points,of:a})+r);const o=t.may("score")&&!this.closed;be(this.save,!o),be(this.close,!o||e.name!=="CHECKLIST"&&s>0);for(const l of this.items.querySelectorAll("input"))be(l,!o);Ae(this.note,this.closed?H("sheet.closed"):s>0?H("sheet.closed_as_draft"):"")}key(){return`${this.name} ${this.of.value}`}open(){const{model:t}=this.page,e=ra(this.name),n=t.hello?.person??"",s=$d(t.notes,n,this.name,this.of.value),r=this.key();this.closed=s?.closed??!1,this.scores={...bc(e,s?.scores??{}),...this.closed?{}:this.drafts.get(r)};const a=document.activeElement?.id;this.items.replaceChildren(z("p",{class:"note"},H(e.name==="CHECKLIST"?"sheet.done":"sheet.low")),...e.items.map(o=>e.name==="CHECKLIST"?this.tick(o.id):this.points(o.id,o.optional===!0))),a?.startsWith("item-")&&document.getElementById(a)?.focus(),this.showOthers(n)}showOthers(t){const e=ra(this.name),n=Ug(this.page.model.notes,t,this.name,this.of.value);this.others.replaceChildren(...n.length>0?n.map(s=>{const{points:r,of:a}=Ou(e,s.scores),o=e.items.map(({id:l})=>`${Al(l)} ${s.scores[l]??"–"}`).join(" · ");return z("details",{},z("summary",{},`${s.person}: ${H("sheet.total",{points:r,of:a})}`),z("p",{},o))}):[z("p",{class:"note"},H(this.closed?"sheet.no_others":"sheet.hidden"))])}set(t,e){this.scores[t]=e,this.drafts.set(this.key(),this.scores),this.update()}points(t,e){const n=ra(this.name),s=[];for(let a=n.range[0];a<=n.range[1];a+=1){const o=z("input",{type:"radio",name:`item-${this.name}-${t}`,id:`item-${this.name}-${t}-${a}`,onchange:()=>this.set(t,a)});o.checked=this.scores[t]===a,s.push(z("label",{class:"point"},o,z("span",{},String(a))))}const r=Al(t)+(e?` (${H("sheet.optional")})`:"");return z("fieldset",{class:"item"},z("legend",{},r),z("div",{class:"points"},...s))}tick(t){const e=z("input",{type:"checkbox",id:`item-${this.name}-${t}`,onchange:()=>this.set(t,e.checked?1:0)});return e.checked=this.scores[t]===1,z("label",{class:"check item"},e,z("span",{},Al(t)))}send(t){const e=bc(ra(this.name),this.scores),n=this.key(),[s,r]=[this.name,this.of.value];this.page.request(H(t?"sheet.close":"sheet.save"),{type:"sheet",sheet:s,of:r,scores:e,closed:t}).then(a=>{a.ok&&this.drafts.delete(n)})}}const Rl=1e3,kg=100;class Og{constructor(t){this.page=t,this.note=z("input",{type:"text",maxlength:300,placeholder:H("marks.placeholder")}),this.ticks=Ei("g"),this.list=z("ol",{class:"log"}),this.known=null,this.end=0,this.begun=null,this.add=He(H("marks.add"),()=>this.mark(),{class:"primary","aria-keyshortcuts":"M"}),this.line=Ei("svg",{class:"timeline",viewBox:`0 0 ${Rl} 40`,preserveAspectRatio:"none",role:"img"},Ei("rect",{x:0,y:19,width:Rl,height:2,class:"line"}),this.ticks),this.note.addEventListener("input",()=>{this.note.value===""?this.begun=null:this.begun??=this.page.model.state?.t??null});const e=z("form",{class:"row",onsubmit:n=>{n.preventDefault(),this.mark()}},Ye(H("marks.note"),this.note),this.add);this.node=qn(H("marks.title"),"timeline-panel",this.line,e,z("div",{class:"scroll log-box",tabindex:0,role:"region","aria-label":H("marks.title")},this.list))}mark(){const t=this.begun??this.page.model.state?.t;if(t===void 0||!this.page.model.may("score"))return;const e=this.note.value.trim();this.page.request(H("marks.add"),{type:"mark",t:Math.round(t*1e3)/1e3,text:e}).then(n=>{!n.ok||this.note.value.trim()!==e||(this.note.value="",this.begun=null)})}update(){const{model:t}=this.page;be(this.add,!t.may("score")),be(this.note,!t.may("score")),Ae(this.add,this.begun===null?H("marks.add"):H("marks.at",{t:ss(this.begun)}));const e=t.state?.t??0,n=60*2**Math.max(0,Math.ceil(Math.log2(Math.max(1,e/60))));if(as(this.line,"aria-label",H("marks.timeline",{t:ss(e)})),t.notes===this.known&&n===this.end)return;this.known=t.notes,this.end=n;const s=t.notes?.marks??[];this.ticks.replaceChildren(...s.map(a=>{const o=Math.min(1,Math.max(0,(a.t??0)/n))*(Rl-6);return Ei("rect",{x:o,y:6,width:6,height:28,rx:2},Ei("title",{},`${ss(a.t)} ${a.text}`))}));const r=[...s].sort((a,o)=>(o.t??0)-(a.t??0)).slice(0,kg);this.list.replaceChildren(...r.length>0?r.map(a=>z("li",{},z("time",{},ss(a.t)),z("span",{},a.text||"–"),z("small",{},a.person))):[z("li",{class:"empty"},H("marks.none"))])}}class Fg{constructor(t){this.page=t,this.slot=z("div",{class:"slot"}),this.timeline=new Og(t);const e=new Ng(t),n=new qd(t);this.parts=[this.timeline,e,n],this.node=z("div",{class:"view evaluator-view"},z("div",{class:"column"},this.slot,this.timeline.node,n.node),z("div",{class:"column"},e.node))}shown(){this.slot.append(this.page.pictureHost)}update(){for(const t of this.parts)t.update()}}/**
 * @license
 * Copyright 2010-2024 Three.js Authors
 * SPDX-License-Identifier: MIT
 */const Ch="169",Cr={ROTATE:0,DOLLY:1,PAN:2},br={ROTATE:0,PAN:1,DOLLY_PAN:2,DOLLY_ROTATE:3},Bg=0,Fu=1,zg=2,Zd=1,Hg=2,Oi=3,us=0,On=1,Fi=2,os=0,Pr=1,Bu=2,zu=3,Hu=4,Gg=5,Rs=100,Vg=101,Wg=102,Xg=103,qg=104,Yg=200,jg=201,Kg=202,$g=203,Tc=204,Ac=205,Zg=206,Jg=207,Qg=208,t_=209,e_=210,n_=211,i_=212,s_=213,r_=214,Rc=0,Cc=1,Pc=2,Ur=3,Lc=4,Dc=5,Ic=6,Uc=7,Ph=0,a_=1,o_=2,ls=0,l_=1,c_=2,h_=3,u_=4,f_=5,d_=6,p_=7,Jd=300,Nr=301,kr=302,Nc=303,kc=304,Qo=306,Oc=1e3,Ls=1001,Fc=1002,ni=1003,m_=1004,Va=1005,ti=1006,Cl=1007,Ds=1008,Vi=1009,Qd=1010,tp=1011,Aa=1012,Lh=1013,Os=1014,Bi=1015,Pa=1016,Dh=1017,Ih=1018,Or=1020,ep=35902,np=1021,ip=1022,fi=1023,sp=1024,rp=1025,Lr=1026,Fr=1027,ap=1028,Uh=1029,op=1030,Nh=1031,kh=1033,Ro=33776,Co=33777,Po=33778,Lo=33779,Bc=35840,zc=35841,Hc=35842,Gc=35843,Vc=36196,Wc=37492,Xc=37496,qc=37808,Yc=37809,jc=37810,Kc=37811,$c=37812,Zc=37813,Jc=37814,Qc=37815,th=37816,eh=37817,nh=37818,ih=37819,sh=37820,rh=37821,Do=36492,ah=36494,oh=36495,lp=36283,lh=36284,ch=36285,hh=36286,g_=3200,__=3201,cp=0,v_=1,is="",yi="srgb",ps="srgb-linear",Oh="display-p3",tl="display-p3-linear",zo="linear",Fe="srgb",Ho="rec709",Go="p3",ir=7680,Gu=519,x_=512,M_=513,y_=514,hp=515,S_=516,E_=517,w_=518,b_=519,uh=35044,Vu="300 es",zi=2e3,Vo=2001;class Hs{addEventListener(t,e){this._listeners===void 0&&(this._listeners={});const n=this._listeners;n[t]===void 0&&(n[t]=[]),n[t].indexOf(e)===-1&&n[t].push(e)}hasEventListener(t,e){if(this._listeners===void 0)return!1;const n=this._listeners;return n[t]!==void 0&&n[t].indexOf(e)!==-1}removeEventListener(t,e){if(this._listeners===void 0)return;const s=this._listeners[t];if(s!==void 0){const r=s.indexOf(e);r!==-1&&s.splice(r,1)}}dispatchEvent(t){if(this._listeners===void 0)return;const n=this._listeners[t.type];if(n!==void 0){t.target=this;const s=n.slice(0);for(let r=0,a=s.length;r<a;r++)s[r].call(this,t);t.target=null}}}const Mn=["00","01","02","03","04","05","06","07","08","09","0a","0b","0c","0d","0e","0f","10","11","12","13","14","15","16","17","18","19","1a","1b","1c","1d","1e","1f","20","21","22","23","24","25","26","27","28","29","2a","2b","2c","2d","2e","2f","30","31","32","33","34","35","36","37","38","39","3a","3b","3c","3d","3e","3f","40","41","42","43","44","45","46","47","48","49","4a","4b","4c","4d","4e","4f","50","51","52","53","54","55","56","57","58","59","5a","5b","5c","5d","5e","5f","60","61","62","63","64","65","66","67","68","69","6a","6b","6c","6d","6e","6f","70","71","72","73","74","75","76","77","78","79","7a","7b","7c","7d","7e","7f","80","81","82","83","84","85","86","87","88","89","8a","8b","8c","8d","8e","8f","90","91","92","93","94","95","96","97","98","99","9a","9b","9c","9d","9e","9f","a0","a1","a2","a3","a4","a5","a6","a7","a8","a9","aa","ab","ac","ad","ae","af","b0","b1","b2","b3","b4","b5","b6","b7","b8","b9","ba","bb","bc","bd","be","bf","c0","c1","c2","c3","c4","c5","c6","c7","c8","c9","ca","cb","cc","cd","ce","cf","d0","d1","d2","d3","d4","d5","d6","d7","d8","d9","da","db","dc","dd","de","df","e0","e1","e2","e3","e4","e5","e6","e7","e8","e9","ea","eb","ec","ed","ee","ef","f0","f1","f2","f3","f4","f5","f6","f7","f8","f9","fa","fb","fc","fd","fe","ff"],Sa=Math.PI/180,fh=180/Math.PI;function cs(){const i=Math.random()*4294967295|0,t=Math.random()*4294967295|0,e=Math.random()*4294967295|0,n=Math.random()*4294967295|0;return(Mn[i&255]+Mn[i>>8&255]+Mn[i>>16&255]+Mn[i>>24&255]+"-"+Mn[t&255]+Mn[t>>8&255]+"-"+Mn[t>>16&15|64]+Mn[t>>24&255]+"-"+Mn[e&63|128]+Mn[e>>8&255]+"-"+Mn[e>>16&255]+Mn[e>>24&255]+Mn[n&255]+Mn[n>>8&255]+Mn[n>>16&255]+Mn[n>>24&255]).toLowerCase()}function Pn(i,t,e){return Math.max(t,Math.min(e,i))}function T_(i,t){return(i%t+t)%t}function Pl(i,t,e){return(1-e)*i+e*t}function wi(i,t){switch(t.constructor){case Float32Array:return i;case Uint32Array:return i/4294967295;case Uint16Array:return i/65535;case Uint8Array:return i/255;case Int32Array:return Math.max(i/2147483647,-1);case Int16Array:return Math.max(i/32767,-1);case Int8Array:return Math.max(i/127,-1);default:throw new Error("Invalid component type.")}}function we(i,t){switch(t.constructor){case Float32Array:return i;case Uint32Array:return Math.round(i*4294967295);case Uint16Array:return Math.round(i*65535);case Uint8Array:return Math.round(i*255);case Int32Array:return Math.round(i*2147483647);case Int16Array:return Math.round(i*32767);case Int8Array:return Math.round(i*127);default:throw new Error("Invalid component type.")}}const A_={DEG2RAD:Sa};class Qt{constructor(t=0,e=0){Qt.prototype.isVector2=!0,this.x=t,this.y=e}get width(){return this.x}set width(t){this.x=t}get height(){return this.y}set height(t){this.y=t}set(t,e){return this.x=t,this.y=e,this}setScalar(t){return this.x=t,this.y=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;default:throw new Error("index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;default:throw new Error("index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y)}copy(t){return this.x=t.x,this.y=t.y,this}add(t){return this.x+=t.x,this.y+=t.y,this}addScalar(t){return this.x+=t,this.y+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this}subScalar(t){return this.x-=t,this.y-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this}multiply(t){return this.x*=t.x,this.y*=t.y,this}multiplyScalar(t){return this.x*=t,this.y*=t,this}divide(t){return this.x/=t.x,this.y/=t.y,this}divideScalar(t){return this.multiplyScalar(1/t)}applyMatrix3(t){const e=this.x,n=this.y,s=t.elements;return this.x=s[0]*e+s[3]*n+s[6],this.y=s[1]*e+s[4]*n+s[7],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this}clamp(t,e){return this.x=Math.max(t.x,Math.min(e.x,this.x)),this.y=Math.max(t.y,Math.min(e.y,this.y)),this}clampScalar(t,e){return this.x=Math.max(t,Math.min(e,this.x)),this.y=Math.max(t,Math.min(e,this.y)),this}clampLength(t,e){const n=this.length();return this.divideScalar(n||1).multiplyScalar(Math.max(t,Math.min(e,n)))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this}negate(){return this.x=-this.x,this.y=-this.y,this}dot(t){return this.x*t.x+this.y*t.y}cross(t){return this.x*t.y-this.y*t.x}lengthSq(){return this.x*this.x+this.y*this.y}length(){return Math.sqrt(this.x*this.x+this.y*this.y)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)}normalize(){return this.divideScalar(this.length()||1)}angle(){return Math.atan2(-this.y,-this.x)+Math.PI}angleTo(t){const e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;const n=this.dot(t)/e;return Math.acos(Pn(n,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){const e=this.x-t.x,n=this.y-t.y;return e*e+n*n}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this}lerpVectors(t,e,n){return this.x=t.x+(e.x-t.x)*n,this.y=t.y+(e.y-t.y)*n,this}equals(t){return t.x===this.x&&t.y===this.y}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this}rotateAround(t,e){const n=Math.cos(e),s=Math.sin(e),r=this.x-t.x,a=this.y-t.y;return this.x=r*n-a*s+t.x,this.y=r*s+a*n+t.y,this}random(){return this.x=Math.random(),this.y=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y}}class oe{constructor(t,e,n,s,r,a,o,l,c){oe.prototype.isMatrix3=!0,this.elements=[1,0,0,0,1,0,0,0,1],t!==void 0&&this.set(t,e,n,s,r,a,o,l,c)}set(t,e,n,s,r,a,o,l,c){const u=this.elements;return u[0]=t,u[1]=s,u[2]=o,u[3]=e,u[4]=r,u[5]=l,u[6]=n,u[7]=a,u[8]=c,this}identity(){return this.set(1,0,0,0,1,0,0,0,1),this}copy(t){const e=this.elements,n=t.elements;return e[0]=n[0],e[1]=n[1],e[2]=n[2],e[3]=n[3],e[4]=n[4],e[5]=n[5],e[6]=n[6],e[7]=n[7],e[8]=n[8],this}extractBasis(t,e,n){return t.setFromMatrix3Column(this,0),e.setFromMatrix3Column(this,1),n.setFromMatrix3Column(this,2),this}setFromMatrix4(t){const e=t.elements;return this.set(e[0],e[4],e[8],e[1],e[5],e[9],e[2],e[6],e[10]),this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){const n=t.elements,s=e.elements,r=this.elements,a=n[0],o=n[3],l=n[6],c=n[1],u=n[4],f=n[7],h=n[2],_=n[5],x=n[8],M=s[0],p=s[3],d=s[6],C=s[1],b=s[4],R=s[7],D=s[2],A=s[5],y=s[8];return r[0]=a*M+o*C+l*D,r[3]=a*p+o*b+l*A,r[6]=a*d+o*R+l*y,r[1]=c*M+u*C+f*D,r[4]=c*p+u*b+f*A,r[7]=c*d+u*R+f*y,r[2]=h*M+_*C+x*D,r[5]=h*p+_*b+x*A,r[8]=h*d+_*R+x*y,this}multiplyScalar(t){const e=this.elements;return e[0]*=t,e[3]*=t,e[6]*=t,e[1]*=t,e[4]*=t,e[7]*=t,e[2]*=t,e[5]*=t,e[8]*=t,this}determinant(){const t=this.elements,e=t[0],n=t[1],s=t[2],r=t[3],a=t[4],o=t[5],l=t[6],c=t[7],u=t[8];return e*a*u-e*o*c-n*r*u+n*o*l+s*r*c-s*a*l}invert(){const t=this.elements,e=t[0],n=t[1],s=t[2],r=t[3],a=t[4],o=t[5],l=t[6],c=t[7],u=t[8],f=u*a-o*c,h=o*l-u*r,_=c*r-a*l,x=e*f+n*h+s*_;if(x===0)return this.set(0,0,0,0,0,0,0,0,0);const M=1/x;return t[0]=f*M,t[1]=(s*c-u*n)*M,t[2]=(o*n-s*a)*M,t[3]=h*M,t[4]=(u*e-s*l)*M,t[5]=(s*r-o*e)*M,t[6]=_*M,t[7]=(n*l-c*e)*M,t[8]=(a*e-n*r)*M,this}transpose(){let t;const e=this.elements;return t=e[1],e[1]=e[3],e[3]=t,t=e[2],e[2]=e[6],e[6]=t,t=e[5],e[5]=e[7],e[7]=t,this}getNormalMatrix(t){return this.setFromMatrix4(t).invert().transpose()}transposeIntoArray(t){const e=this.elements;return t[0]=e[0],t[1]=e[3],t[2]=e[6],t[3]=e[1],t[4]=e[4],t[5]=e[7],t[6]=e[2],t[7]=e[5],t[8]=e[8],this}setUvTransform(t,e,n,s,r,a,o){const l=Math.cos(r),c=Math.sin(r);return this.set(n*l,n*c,-n*(l*a+c*o)+a+t,-s*c,s*l,-s*(-c*a+l*o)+o+e,0,0,1),this}scale(t,e){return this.premultiply(Ll.makeScale(t,e)),this}rotate(t){return this.premultiply(Ll.makeRotation(-t)),this}translate(t,e){return this.premultiply(Ll.makeTranslation(t,e)),this}makeTranslation(t,e){return t.isVector2?this.set(1,0,t.x,0,1,t.y,0,0,1):this.set(1,0,t,0,1,e,0,0,1),this}makeRotation(t){const e=Math.cos(t),n=Math.sin(t);return this.set(e,-n,0,n,e,0,0,0,1),this}makeScale(t,e){return this.set(t,0,0,0,e,0,0,0,1),this}equals(t){const e=this.elements,n=t.elements;for(let s=0;s<9;s++)if(e[s]!==n[s])return!1;return!0}fromArray(t,e=0){for(let n=0;n<9;n++)this.elements[n]=t[n+e];return this}toArray(t=[],e=0){const n=this.elements;return t[e]=n[0],t[e+1]=n[1],t[e+2]=n[2],t[e+3]=n[3],t[e+4]=n[4],t[e+5]=n[5],t[e+6]=n[6],t[e+7]=n[7],t[e+8]=n[8],t}clone(){return new this.constructor().fromArray(this.elements)}}const Ll=new oe;function up(i){for(let t=i.length-1;t>=0;--t)if(i[t]>=65535)return!0;return!1}function Wo(i){return document.createElementNS("http://www.w3.org/1999/xhtml",i)}function R_(){const i=Wo("canvas");return i.style.display="block",i}const Wu={};function Io(i){i in Wu||(Wu[i]=!0,console.warn(i))}function C_(i,t,e){return new Promise(function(n,s){function r(){switch(i.clientWaitSync(t,i.SYNC_FLUSH_COMMANDS_BIT,0)){case i.WAIT_FAILED:s();break;case i.TIMEOUT_EXPIRED:setTimeout(r,e);break;default:n()}}setTimeout(r,e)})}function P_(i){const t=i.elements;t[2]=.5*t[2]+.5*t[3],t[6]=.5*t[6]+.5*t[7],t[10]=.5*t[10]+.5*t[11],t[14]=.5*t[14]+.5*t[15]}function L_(i){const t=i.elements;t[11]===-1?(t[10]=-t[10]-1,t[14]=-t[14]):(t[10]=-t[10],t[14]=-t[14]+1)}const Xu=new oe().set(.8224621,.177538,0,.0331941,.9668058,0,.0170827,.0723974,.9105199),qu=new oe().set(1.2249401,-.2249404,0,-.0420569,1.0420571,0,-.0196376,-.0786361,1.0982735),aa={[ps]:{transfer:zo,primaries:Ho,luminanceCoefficients:[.2126,.7152,.0722],toReference:i=>i,fromReference:i=>i},[yi]:{transfer:Fe,primaries:Ho,luminanceCoefficients:[.2126,.7152,.0722],toReference:i=>i.convertSRGBToLinear(),fromReference:i=>i.convertLinearToSRGB()},[tl]:{transfer:zo,primaries:Go,luminanceCoefficients:[.2289,.6917,.0793],toReference:i=>i.applyMatrix3(qu),fromReference:i=>i.applyMatrix3(Xu)},[Oh]:{transfer:Fe,primaries:Go,luminanceCoefficients:[.2289,.6917,.0793],toReference:i=>i.convertSRGBToLinear().applyMatrix3(qu),fromReference:i=>i.applyMatrix3(Xu).convertLinearToSRGB()}},D_=new Set([ps,tl]),ye={enabled:!0,_workingColorSpace:ps,get workingColorSpace(){return this._workingColorSpace},set workingColorSpace(i){if(!D_.has(i))throw new Error(`Unsupported working color space, "${i}".`);this._workingColorSpace=i},convert:function(i,t,e){if(this.enabled===!1||t===e||!t||!e)return i;const n=aa[t].toReference,s=aa[e].fromReference;return s(n(i))},fromWorkingColorSpace:function(i,t){return this.convert(i,this._workingColorSpace,t)},toWorkingColorSpace:function(i,t){return this.convert(i,t,this._workingColorSpace)},getPrimaries:function(i){return aa[i].primaries},getTransfer:function(i){return i===is?zo:aa[i].transfer},getLuminanceCoefficients:function(i,t=this._workingColorSpace){return i.fromArray(aa[t].luminanceCoefficients)}};function Dr(i){return i<.04045?i*.0773993808:Math.pow(i*.9478672986+.0521327014,2.4)}function Dl(i){return i<.0031308?i*12.92:1.055*Math.pow(i,.41666)-.055}let sr;class I_{static getDataURL(t){if(/^data:/i.test(t.src)||typeof HTMLCanvasElement>"u")return t.src;let e;if(t instanceof HTMLCanvasElement)e=t;else{sr===void 0&&(sr=Wo("canvas")),sr.width=t.width,sr.height=t.height;const n=sr.getContext("2d");t instanceof ImageData?n.putImageData(t,0,0):n.drawImage(t,0,0,t.width,t.height),e=sr}return e.width>2048||e.height>2048?(console.warn("THREE.ImageUtils.getDataURL: Image converted to jpg for performance reasons",t),e.toDataURL("image/jpeg",.6)):e.toDataURL("image/png")}static sRGBToLinear(t){if(typeof HTMLImageElement<"u"&&t instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&t instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&t instanceof ImageBitmap){const e=Wo("canvas");e.width=t.width,e.height=t.height;const n=e.getContext("2d");n.drawImage(t,0,0,t.width,t.height);const s=n.getImageData(0,0,t.width,t.height),r=s.data;for(let a=0;a<r.length;a++)r[a]=Dr(r[a]/255)*255;return n.putImageData(s,0,0),e}else if(t.data){const e=t.data.slice(0);for(let n=0;n<e.length;n++)e instanceof Uint8Array||e instanceof Uint8ClampedArray?e[n]=Math.floor(Dr(e[n]/255)*255):e[n]=Dr(e[n]);return{data:e,width:t.width,height:t.height}}else return console.warn("THREE.ImageUtils.sRGBToLinear(): Unsupported image type. No color space conversion applied."),t}}let U_=0;class fp{constructor(t=null){this.isSource=!0,Object.defineProperty(this,"id",{value:U_++}),this.uuid=cs(),this.data=t,this.dataReady=!0,this.version=0}set needsUpdate(t){t===!0&&this.version++}toJSON(t){const e=t===void 0||typeof t=="string";if(!e&&t.images[this.uuid]!==void 0)return t.images[this.uuid];const n={uuid:this.uuid,url:""},s=this.data;if(s!==null){let r;if(Array.isArray(s)){r=[];for(let a=0,o=s.length;a<o;a++)s[a].isDataTexture?r.push(Il(s[a].image)):r.push(Il(s[a]))}else r=Il(s);n.url=r}return e||(t.images[this.uuid]=n),n}}function Il(i){return typeof HTMLImageElement<"u"&&i instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&i instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&i instanceof ImageBitmap?I_.getDataURL(i):i.data?{data:Array.from(i.data),width:i.width,height:i.height,type:i.data.constructor.name}:(console.warn("THREE.Texture: Unable to serialize Texture."),{})}let N_=0;class Ln extends Hs{constructor(t=Ln.DEFAULT_IMAGE,e=Ln.DEFAULT_MAPPING,n=Ls,s=Ls,r=ti,a=Ds,o=fi,l=Vi,c=Ln.DEFAULT_ANISOTROPY,u=is){super(),this.isTexture=!0,Object.defineProperty(this,"id",{value:N_++}),this.uuid=cs(),this.name="",this.source=new fp(t),this.mipmaps=[],this.mapping=e,this.channel=0,this.wrapS=n,this.wrapT=s,this.magFilter=r,this.minFilter=a,this.anisotropy=c,this.format=o,this.internalFormat=null,this.type=l,this.offset=new Qt(0,0),this.repeat=new Qt(1,1),this.center=new Qt(0,0),this.rotation=0,this.matrixAutoUpdate=!0,this.matrix=new oe,this.generateMipmaps=!0,this.premultiplyAlpha=!1,this.flipY=!0,this.unpackAlignment=4,this.colorSpace=u,this.userData={},this.version=0,this.onUpdate=null,this.isRenderTargetTexture=!1,this.pmremVersion=0}get image(){return this.source.data}set image(t=null){this.source.data=t}updateMatrix(){this.matrix.setUvTransform(this.offset.x,this.offset.y,this.repeat.x,this.repeat.y,this.rotation,this.center.x,this.center.y)}clone(){return new this.constructor().copy(this)}copy(t){return this.name=t.name,this.source=t.source,this.mipmaps=t.mipmaps.slice(0),this.mapping=t.mapping,this.channel=t.channel,this.wrapS=t.wrapS,this.wrapT=t.wrapT,this.magFilter=t.magFilter,this.minFilter=t.minFilter,this.anisotropy=t.anisotropy,this.format=t.format,this.internalFormat=t.internalFormat,this.type=t.type,this.offset.copy(t.offset),this.repeat.copy(t.repeat),this.center.copy(t.center),this.rotation=t.rotation,this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrix.copy(t.matrix),this.generateMipmaps=t.generateMipmaps,this.premultiplyAlpha=t.premultiplyAlpha,this.flipY=t.flipY,this.unpackAlignment=t.unpackAlignment,this.colorSpace=t.colorSpace,this.userData=JSON.parse(JSON.stringify(t.userData)),this.needsUpdate=!0,this}toJSON(t){const e=t===void 0||typeof t=="string";if(!e&&t.textures[this.uuid]!==void 0)return t.textures[this.uuid];const n={metadata:{version:4.6,type:"Texture",generator:"Texture.toJSON"},uuid:this.uuid,name:this.name,image:this.source.toJSON(t).uuid,mapping:this.mapping,channel:this.channel,repeat:[this.repeat.x,this.repeat.y],offset:[this.offset.x,this.offset.y],center:[this.center.x,this.center.y],rotation:this.rotation,wrap:[this.wrapS,this.wrapT],format:this.format,internalFormat:this.internalFormat,type:this.type,colorSpace:this.colorSpace,minFilter:this.minFilter,magFilter:this.magFilter,anisotropy:this.anisotropy,flipY:this.flipY,generateMipmaps:this.generateMipmaps,premultiplyAlpha:this.premultiplyAlpha,unpackAlignment:this.unpackAlignment};return Object.keys(this.userData).length>0&&(n.userData=this.userData),e||(t.textures[this.uuid]=n),n}dispose(){this.dispatchEvent({type:"dispose"})}transformUv(t){if(this.mapping!==Jd)return t;if(t.applyMatrix3(this.matrix),t.x<0||t.x>1)switch(this.wrapS){case Oc:t.x=t.x-Math.floor(t.x);break;case Ls:t.x=t.x<0?0:1;break;case Fc:Math.abs(Math.floor(t.x)%2)===1?t.x=Math.ceil(t.x)-t.x:t.x=t.x-Math.floor(t.x);break}if(t.y<0||t.y>1)switch(this.wrapT){case Oc:t.y=t.y-Math.floor(t.y);break;case Ls:t.y=t.y<0?0:1;break;case Fc:Math.abs(Math.floor(t.y)%2)===1?t.y=Math.ceil(t.y)-t.y:t.y=t.y-Math.floor(t.y);break}return this.flipY&&(t.y=1-t.y),t}set needsUpdate(t){t===!0&&(this.version++,this.source.needsUpdate=!0)}set needsPMREMUpdate(t){t===!0&&this.pmremVersion++}}Ln.DEFAULT_IMAGE=null;Ln.DEFAULT_MAPPING=Jd;Ln.DEFAULT_ANISOTROPY=1;class je{constructor(t=0,e=0,n=0,s=1){je.prototype.isVector4=!0,this.x=t,this.y=e,this.z=n,this.w=s}get width(){return this.z}set width(t){this.z=t}get height(){return this.w}set height(t){this.w=t}set(t,e,n,s){return this.x=t,this.y=e,this.z=n,this.w=s,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this.w=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setW(t){return this.w=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;case 3:this.w=e;break;default:throw new Error("index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;case 3:return this.w;default:throw new Error("index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z,this.w)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this.w=t.w!==void 0?t.w:1,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this.w+=t.w,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this.w+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this.w=t.w+e.w,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this.w+=t.w*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this.w-=t.w,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this.w-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this.w=t.w-e.w,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this.w*=t.w,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this.w*=t,this}applyMatrix4(t){const e=this.x,n=this.y,s=this.z,r=this.w,a=t.elements;return this.x=a[0]*e+a[4]*n+a[8]*s+a[12]*r,this.y=a[1]*e+a[5]*n+a[9]*s+a[13]*r,this.z=a[2]*e+a[6]*n+a[10]*s+a[14]*r,this.w=a[3]*e+a[7]*n+a[11]*s+a[15]*r,this}divideScalar(t){return this.multiplyScalar(1/t)}setAxisAngleFromQuaternion(t){this.w=2*Math.acos(t.w);const e=Math.sqrt(1-t.w*t.w);return e<1e-4?(this.x=1,this.y=0,this.z=0):(this.x=t.x/e,this.y=t.y/e,this.z=t.z/e),this}setAxisAngleFromRotationMatrix(t){let e,n,s,r;const l=t.elements,c=l[0],u=l[4],f=l[8],h=l[1],_=l[5],x=l[9],M=l[2],p=l[6],d=l[10];if(Math.abs(u-h)<.01&&Math.abs(f-M)<.01&&Math.abs(x-p)<.01){if(Math.abs(u+h)<.1&&Math.abs(f+M)<.1&&Math.abs(x+p)<.1&&Math.abs(c+_+d-3)<.1)return this.set(1,0,0,0),this;e=Math.PI;const b=(c+1)/2,R=(_+1)/2,D=(d+1)/2,A=(u+h)/4,y=(f+M)/4,P=(x+p)/4;return b>R&&b>D?b<.01?(n=0,s=.707106781,r=.707106781):(n=Math.sqrt(b),s=A/n,r=y/n):R>D?R<.01?(n=.707106781,s=0,r=.707106781):(s=Math.sqrt(R),n=A/s,r=P/s):D<.01?(n=.707106781,s=.707106781,r=0):(r=Math.sqrt(D),n=y/r,s=P/r),this.set(n,s,r,e),this}let C=Math.sqrt((p-x)*(p-x)+(f-M)*(f-M)+(h-u)*(h-u));return Math.abs(C)<.001&&(C=1),this.x=(p-x)/C,this.y=(f-M)/C,this.z=(h-u)/C,this.w=Math.acos((c+_+d-1)/2),this}setFromMatrixPosition(t){const e=t.elements;return this.x=e[12],this.y=e[13],this.z=e[14],this.w=e[15],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this.w=Math.min(this.w,t.w),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this.w=Math.max(this.w,t.w),this}clamp(t,e){return this.x=Math.max(t.x,Math.min(e.x,this.x)),this.y=Math.max(t.y,Math.min(e.y,this.y)),this.z=Math.max(t.z,Math.min(e.z,this.z)),this.w=Math.max(t.w,Math.min(e.w,this.w)),this}clampScalar(t,e){return this.x=Math.max(t,Math.min(e,this.x)),this.y=Math.max(t,Math.min(e,this.y)),this.z=Math.max(t,Math.min(e,this.z)),this.w=Math.max(t,Math.min(e,this.w)),this}clampLength(t,e){const n=this.length();return this.divideScalar(n||1).multiplyScalar(Math.max(t,Math.min(e,n)))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this.w=Math.floor(this.w),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this.w=Math.ceil(this.w),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this.w=Math.round(this.w),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this.w=Math.trunc(this.w),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this.w=-this.w,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z+this.w*t.w}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)+Math.abs(this.w)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this.w+=(t.w-this.w)*e,this}lerpVectors(t,e,n){return this.x=t.x+(e.x-t.x)*n,this.y=t.y+(e.y-t.y)*n,this.z=t.z+(e.z-t.z)*n,this.w=t.w+(e.w-t.w)*n,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z&&t.w===this.w}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this.w=t[e+3],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t[e+3]=this.w,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this.w=t.getW(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this.w=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z,yield this.w}}class k_ extends Hs{constructor(t=1,e=1,n={}){super(),this.isRenderTarget=!0,this.width=t,this.height=e,this.depth=1,this.scissor=new je(0,0,t,e),this.scissorTest=!1,this.viewport=new je(0,0,t,e);const s={width:t,height:e,depth:1};n=Object.assign({generateMipmaps:!1,internalFormat:null,minFilter:ti,depthBuffer:!0,stencilBuffer:!1,resolveDepthBuffer:!0,resolveStencilBuffer:!0,depthTexture:null,samples:0,count:1},n);const r=new Ln(s,n.mapping,n.wrapS,n.wrapT,n.magFilter,n.minFilter,n.format,n.type,n.anisotropy,n.colorSpace);r.flipY=!1,r.generateMipmaps=n.generateMipmaps,r.internalFormat=n.internalFormat,this.textures=[];const a=n.count;for(let o=0;o<a;o++)this.textures[o]=r.clone(),this.textures[o].isRenderTargetTexture=!0;this.depthBuffer=n.depthBuffer,this.stencilBuffer=n.stencilBuffer,this.resolveDepthBuffer=n.resolveDepthBuffer,this.resolveStencilBuffer=n.resolveStencilBuffer,this.depthTexture=n.depthTexture,this.samples=n.samples}get texture(){return this.textures[0]}set texture(t){this.textures[0]=t}setSize(t,e,n=1){if(this.width!==t||this.height!==e||this.depth!==n){this.width=t,this.height=e,this.depth=n;for(let s=0,r=this.textures.length;s<r;s++)this.textures[s].image.width=t,this.textures[s].image.height=e,this.textures[s].image.depth=n;this.dispose()}this.viewport.set(0,0,t,e),this.scissor.set(0,0,t,e)}clone(){return new this.constructor().copy(this)}copy(t){this.width=t.width,this.height=t.height,this.depth=t.depth,this.scissor.copy(t.scissor),this.scissorTest=t.scissorTest,this.viewport.copy(t.viewport),this.textures.length=0;for(let n=0,s=t.textures.length;n<s;n++)this.textures[n]=t.textures[n].clone(),this.textures[n].isRenderTargetTexture=!0;const e=Object.assign({},t.texture.image);return this.texture.source=new fp(e),this.depthBuffer=t.depthBuffer,this.stencilBuffer=t.stencilBuffer,this.resolveDepthBuffer=t.resolveDepthBuffer,this.resolveStencilBuffer=t.resolveStencilBuffer,t.depthTexture!==null&&(this.depthTexture=t.depthTexture.clone()),this.samples=t.samples,this}dispose(){this.dispatchEvent({type:"dispose"})}}class Fs extends k_{constructor(t=1,e=1,n={}){super(t,e,n),this.isWebGLRenderTarget=!0}}class dp extends Ln{constructor(t=null,e=1,n=1,s=1){super(null),this.isDataArrayTexture=!0,this.image={data:t,width:e,height:n,depth:s},this.magFilter=ni,this.minFilter=ni,this.wrapR=Ls,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1,this.layerUpdates=new Set}addLayerUpdate(t){this.layerUpdates.add(t)}clearLayerUpdates(){this.layerUpdates.clear()}}class O_ extends Ln{constructor(t=null,e=1,n=1,s=1){super(null),this.isData3DTexture=!0,this.image={data:t,width:e,height:n,depth:s},this.magFilter=ni,this.minFilter=ni,this.wrapR=Ls,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}}class Bs{constructor(t=0,e=0,n=0,s=1){this.isQuaternion=!0,this._x=t,this._y=e,this._z=n,this._w=s}static slerpFlat(t,e,n,s,r,a,o){let l=n[s+0],c=n[s+1],u=n[s+2],f=n[s+3];const h=r[a+0],_=r[a+1],x=r[a+2],M=r[a+3];if(o===0){t[e+0]=l,t[e+1]=c,t[e+2]=u,t[e+3]=f;return}if(o===1){t[e+0]=h,t[e+1]=_,t[e+2]=x,t[e+3]=M;return}if(f!==M||l!==h||c!==_||u!==x){let p=1-o;const d=l*h+c*_+u*x+f*M,C=d>=0?1:-1,b=1-d*d;if(b>Number.EPSILON){const D=Math.sqrt(b),A=Math.atan2(D,d*C);p=Math.sin(p*A)/D,o=Math.sin(o*A)/D}const R=o*C;if(l=l*p+h*R,c=c*p+_*R,u=u*p+x*R,f=f*p+M*R,p===1-o){const D=1/Math.sqrt(l*l+c*c+u*u+f*f);l*=D,c*=D,u*=D,f*=D}}t[e]=l,t[e+1]=c,t[e+2]=u,t[e+3]=f}static multiplyQuaternionsFlat(t,e,n,s,r,a){const o=n[s],l=n[s+1],c=n[s+2],u=n[s+3],f=r[a],h=r[a+1],_=r[a+2],x=r[a+3];return t[e]=o*x+u*f+l*_-c*h,t[e+1]=l*x+u*h+c*f-o*_,t[e+2]=c*x+u*_+o*h-l*f,t[e+3]=u*x-o*f-l*h-c*_,t}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get w(){return this._w}set w(t){this._w=t,this._onChangeCallback()}set(t,e,n,s){return this._x=t,this._y=e,this._z=n,this._w=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._w)}copy(t){return this._x=t.x,this._y=t.y,this._z=t.z,this._w=t.w,this._onChangeCallback(),this}setFromEuler(t,e=!0){const n=t._x,s=t._y,r=t._z,a=t._order,o=Math.cos,l=Math.sin,c=o(n/2),u=o(s/2),f=o(r/2),h=l(n/2),_=l(s/2),x=l(r/2);switch(a){case"XYZ":this._x=h*u*f+c*_*x,this._y=c*_*f-h*u*x,this._z=c*u*x+h*_*f,this._w=c*u*f-h*_*x;break;case"YXZ":this._x=h*u*f+c*_*x,this._y=c*_*f-h*u*x,this._z=c*u*x-h*_*f,this._w=c*u*f+h*_*x;break;case"ZXY":this._x=h*u*f-c*_*x,this._y=c*_*f+h*u*x,this._z=c*u*x+h*_*f,this._w=c*u*f-h*_*x;break;case"ZYX":this._x=h*u*f-c*_*x,this._y=c*_*f+h*u*x,this._z=c*u*x-h*_*f,this._w=c*u*f+h*_*x;break;case"YZX":this._x=h*u*f+c*_*x,this._y=c*_*f+h*u*x,this._z=c*u*x-h*_*f,this._w=c*u*f-h*_*x;break;case"XZY":this._x=h*u*f-c*_*x,this._y=c*_*f-h*u*x,this._z=c*u*x+h*_*f,this._w=c*u*f+h*_*x;break;default:console.warn("THREE.Quaternion: .setFromEuler() encountered an unknown order: "+a)}return e===!0&&this._onChangeCallback(),this}setFromAxisAngle(t,e){const n=e/2,s=Math.sin(n);return this._x=t.x*s,this._y=t.y*s,this._z=t.z*s,this._w=Math.cos(n),this._onChangeCallback(),this}setFromRotationMatrix(t){const e=t.elements,n=e[0],s=e[4],r=e[8],a=e[1],o=e[5],l=e[9],c=e[2],u=e[6],f=e[10],h=n+o+f;if(h>0){const _=.5/Math.sqrt(h+1);this._w=.25/_,this._x=(u-l)*_,this._y=(r-c)*_,this._z=(a-s)*_}else if(n>o&&n>f){const _=2*Math.sqrt(1+n-o-f);this._w=(u-l)/_,this._x=.25*_,this._y=(s+a)/_,this._z=(r+c)/_}else if(o>f){const _=2*Math.sqrt(1+o-n-f);this._w=(r-c)/_,this._x=(s+a)/_,this._y=.25*_,this._z=(l+u)/_}else{const _=2*Math.sqrt(1+f-n-o);this._w=(a-s)/_,this._x=(r+c)/_,this._y=(l+u)/_,this._z=.25*_}return this._onChangeCallback(),this}setFromUnitVectors(t,e){let n=t.dot(e)+1;return n<Number.EPSILON?(n=0,Math.abs(t.x)>Math.abs(t.z)?(this._x=-t.y,this._y=t.x,this._z=0,this._w=n):(this._x=0,this._y=-t.z,this._z=t.y,this._w=n)):(this._x=t.y*e.z-t.z*e.y,this._y=t.z*e.x-t.x*e.z,this._z=t.x*e.y-t.y*e.x,this._w=n),this.normalize()}angleTo(t){return 2*Math.acos(Math.abs(Pn(this.dot(t),-1,1)))}rotateTowards(t,e){const n=this.angleTo(t);if(n===0)return this;const s=Math.min(1,e/n);return this.slerp(t,s),this}identity(){return this.set(0,0,0,1)}invert(){return this.conjugate()}conjugate(){return this._x*=-1,this._y*=-1,this._z*=-1,this._onChangeCallback(),this}dot(t){return this._x*t._x+this._y*t._y+this._z*t._z+this._w*t._w}lengthSq(){return this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w}length(){return Math.sqrt(this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w)}normalize(){let t=this.length();return t===0?(this._x=0,this._y=0,this._z=0,this._w=1):(t=1/t,this._x=this._x*t,this._y=this._y*t,this._z=this._z*t,this._w=this._w*t),this._onChangeCallback(),this}multiply(t){return this.multiplyQuaternions(this,t)}premultiply(t){return this.multiplyQuaternions(t,this)}multiplyQuaternions(t,e){const n=t._x,s=t._y,r=t._z,a=t._w,o=e._x,l=e._y,c=e._z,u=e._w;return this._x=n*u+a*o+s*c-r*l,this._y=s*u+a*l+r*o-n*c,this._z=r*u+a*c+n*l-s*o,this._w=a*u-n*o-s*l-r*c,this._onChangeCallback(),this}slerp(t,e){if(e===0)return this;if(e===1)return this.copy(t);const n=this._x,s=this._y,r=this._z,a=this._w;let o=a*t._w+n*t._x+s*t._y+r*t._z;if(o<0?(this._w=-t._w,this._x=-t._x,this._y=-t._y,this._z=-t._z,o=-o):this.copy(t),o>=1)return this._w=a,this._x=n,this._y=s,this._z=r,this;const l=1-o*o;if(l<=Number.EPSILON){const _=1-e;return this._w=_*a+e*this._w,this._x=_*n+e*this._x,this._y=_*s+e*this._y,this._z=_*r+e*this._z,this.normalize(),this}const c=Math.sqrt(l),u=Math.atan2(c,o),f=Math.sin((1-e)*u)/c,h=Math.sin(e*u)/c;return this._w=a*f+this._w*h,this._x=n*f+this._x*h,this._y=s*f+this._y*h,this._z=r*f+this._z*h,this._onChangeCallback(),this}slerpQuaternions(t,e,n){return this.copy(t).slerp(e,n)}random(){const t=2*Math.PI*Math.random(),e=2*Math.PI*Math.random(),n=Math.random(),s=Math.sqrt(1-n),r=Math.sqrt(n);return this.set(s*Math.sin(t),s*Math.cos(t),r*Math.sin(e),r*Math.cos(e))}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._w===this._w}fromArray(t,e=0){return this._x=t[e],this._y=t[e+1],this._z=t[e+2],this._w=t[e+3],this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._w,t}fromBufferAttribute(t,e){return this._x=t.getX(e),this._y=t.getY(e),this._z=t.getZ(e),this._w=t.getW(e),this._onChangeCallback(),this}toJSON(){return this.toArray()}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._w}}class j{constructor(t=0,e=0,n=0){j.prototype.isVector3=!0,this.x=t,this.y=e,this.z=n}set(t,e,n){return n===void 0&&(n=this.z),this.x=t,this.y=e,this.z=n,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;default:throw new Error("index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;default:throw new Error("index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this}multiplyVectors(t,e){return this.x=t.x*e.x,this.y=t.y*e.y,this.z=t.z*e.z,this}applyEuler(t){return this.applyQuaternion(Yu.setFromEuler(t))}applyAxisAngle(t,e){return this.applyQuaternion(Yu.setFromAxisAngle(t,e))}applyMatrix3(t){const e=this.x,n=this.y,s=this.z,r=t.elements;return this.x=r[0]*e+r[3]*n+r[6]*s,this.y=r[1]*e+r[4]*n+r[7]*s,this.z=r[2]*e+r[5]*n+r[8]*s,this}applyNormalMatrix(t){return this.applyMatrix3(t).normalize()}applyMatrix4(t){const e=this.x,n=this.y,s=this.z,r=t.elements,a=1/(r[3]*e+r[7]*n+r[11]*s+r[15]);return this.x=(r[0]*e+r[4]*n+r[8]*s+r[12])*a,this.y=(r[1]*e+r[5]*n+r[9]*s+r[13])*a,this.z=(r[2]*e+r[6]*n+r[10]*s+r[14])*a,this}applyQuaternion(t){const e=this.x,n=this.y,s=this.z,r=t.x,a=t.y,o=t.z,l=t.w,c=2*(a*s-o*n),u=2*(o*e-r*s),f=2*(r*n-a*e);return this.x=e+l*c+a*f-o*u,this.y=n+l*u+o*c-r*f,this.z=s+l*f+r*u-a*c,this}project(t){return this.applyMatrix4(t.matrixWorldInverse).applyMatrix4(t.projectionMatrix)}unproject(t){return this.applyMatrix4(t.projectionMatrixInverse).applyMatrix4(t.matrixWorld)}transformDirection(t){const e=this.x,n=this.y,s=this.z,r=t.elements;return this.x=r[0]*e+r[4]*n+r[8]*s,this.y=r[1]*e+r[5]*n+r[9]*s,this.z=r[2]*e+r[6]*n+r[10]*s,this.normalize()}divide(t){return this.x/=t.x,this.y/=t.y,this.z/=t.z,this}divideScalar(t){return this.multiplyScalar(1/t)}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this}clamp(t,e){return this.x=Math.max(t.x,Math.min(e.x,this.x)),this.y=Math.max(t.y,Math.min(e.y,this.y)),this.z=Math.max(t.z,Math.min(e.z,this.z)),this}clampScalar(t,e){return this.x=Math.max(t,Math.min(e,this.x)),this.y=Math.max(t,Math.min(e,this.y)),this.z=Math.max(t,Math.min(e,this.z)),this}clampLength(t,e){const n=this.length();return this.divideScalar(n||1).multiplyScalar(Math.max(t,Math.min(e,n)))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this}lerpVectors(t,e,n){return this.x=t.x+(e.x-t.x)*n,this.y=t.y+(e.y-t.y)*n,this.z=t.z+(e.z-t.z)*n,this}cross(t){return this.crossVectors(this,t)}crossVectors(t,e){const n=t.x,s=t.y,r=t.z,a=e.x,o=e.y,l=e.z;return this.x=s*l-r*o,this.y=r*a-n*l,this.z=n*o-s*a,this}projectOnVector(t){const e=t.lengthSq();if(e===0)return this.set(0,0,0);const n=t.dot(this)/e;return this.copy(t).multiplyScalar(n)}projectOnPlane(t){return Ul.copy(this).projectOnVector(t),this.sub(Ul)}reflect(t){return this.sub(Ul.copy(t).multiplyScalar(2*this.dot(t)))}angleTo(t){const e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;const n=this.dot(t)/e;return Math.acos(Pn(n,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){const e=this.x-t.x,n=this.y-t.y,s=this.z-t.z;return e*e+n*n+s*s}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)+Math.abs(this.z-t.z)}setFromSpherical(t){return this.setFromSphericalCoords(t.radius,t.phi,t.theta)}setFromSphericalCoords(t,e,n){const s=Math.sin(e)*t;return this.x=s*Math.sin(n),this.y=Math.cos(e)*t,this.z=s*Math.cos(n),this}setFromCylindrical(t){return this.setFromCylindricalCoords(t.radius,t.theta,t.y)}setFromCylindricalCoords(t,e,n){return this.x=t*Math.sin(e),this.y=n,this.z=t*Math.cos(e),this}setFromMatrixPosition(t){const e=t.elements;return this.x=e[12],this.y=e[13],this.z=e[14],this}setFromMatrixScale(t){const e=this.setFromMatrixColumn(t,0).length(),n=this.setFromMatrixColumn(t,1).length(),s=this.setFromMatrixColumn(t,2).length();return this.x=e,this.y=n,this.z=s,this}setFromMatrixColumn(t,e){return this.fromArray(t.elements,e*4)}setFromMatrix3Column(t,e){return this.fromArray(t.elements,e*3)}setFromEuler(t){return this.x=t._x,this.y=t._y,this.z=t._z,this}setFromColor(t){return this.x=t.r,this.y=t.g,this.z=t.b,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this}randomDirection(){const t=Math.random()*Math.PI*2,e=Math.random()*2-1,n=Math.sqrt(1-e*e);return this.x=n*Math.cos(t),this.y=e,this.z=n*Math.sin(t),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z}}const Ul=new j,Yu=new Bs;class La{constructor(t=new j(1/0,1/0,1/0),e=new j(-1/0,-1/0,-1/0)){this.isBox3=!0,this.min=t,this.max=e}set(t,e){return this.min.copy(t),this.max.copy(e),this}setFromArray(t){this.makeEmpty();for(let e=0,n=t.length;e<n;e+=3)this.expandByPoint(oi.fromArray(t,e));return this}setFromBufferAttribute(t){this.makeEmpty();for(let e=0,n=t.count;e<n;e++)this.expandByPoint(oi.fromBufferAttribute(t,e));return this}setFromPoints(t){this.makeEmpty();for(let e=0,n=t.length;e<n;e++)this.expandByPoint(t[e]);return this}setFromCenterAndSize(t,e){const n=oi.copy(e).multiplyScalar(.5);return this.min.copy(t).sub(n),this.max.copy(t).add(n),this}setFromObject(t,e=!1){return this.makeEmpty(),this.expandByObject(t,e)}clone(){return new this.constructor().copy(this)}copy(t){return this.min.copy(t.min),this.max.copy(t.max),this}makeEmpty(){return this.min.x=this.min.y=this.min.z=1/0,this.max.x=this.max.y=this.max.z=-1/0,this}isEmpty(){return this.max.x<this.min.x||this.max.y<this.min.y||this.max.z<this.min.z}getCenter(t){return this.isEmpty()?t.set(0,0,0):t.addVectors(this.min,this.max).multiplyScalar(.5)}getSize(t){return this.isEmpty()?t.set(0,0,0):t.subVectors(this.max,this.min)}expandByPoint(t){return this.min.min(t),this.max.max(t),this}expandByVector(t){return this.min.sub(t),this.max.add(t),this}expandByScalar(t){return this.min.addScalar(-t),this.max.addScalar(t),this}expandByObject(t,e=!1){t.updateWorldMatrix(!1,!1);const n=t.geometry;if(n!==void 0){const r=n.getAttribute("position");if(e===!0&&r!==void 0&&t.isInstancedMesh!==!0)for(let a=0,o=r.count;a<o;a++)t.isMesh===!0?t.getVertexPosition(a,oi):oi.fromBufferAttribute(r,a),oi.applyMatrix4(t.matrixWorld),this.expandByPoint(oi);else t.boundingBox!==void 0?(t.boundingBox===null&&t.computeBoundingBox(),Wa.copy(t.boundingBox)):(n.boundingBox===null&&n.computeBoundingBox(),Wa.copy(n.boundingBox)),Wa.applyMatrix4(t.matrixWorld),this.union(Wa)}const s=t.children;for(let r=0,a=s.length;r<a;r++)this.expandByObject(s[r],e);return this}containsPoint(t){return t.x>=this.min.x&&t.x<=this.max.x&&t.y>=this.min.y&&t.y<=this.max.y&&t.z>=this.min.z&&t.z<=this.max.z}containsBox(t){return this.min.x<=t.min.x&&t.max.x<=this.max.x&&this.min.y<=t.min.y&&t.max.y<=this.max.y&&this.min.z<=t.min.z&&t.max.z<=this.max.z}getParameter(t,e){return e.set((t.x-this.min.x)/(this.max.x-this.min.x),(t.y-this.min.y)/(this.max.y-this.min.y),(t.z-this.min.z)/(this.max.z-this.min.z))}intersectsBox(t){return t.max.x>=this.min.x&&t.min.x<=this.max.x&&t.max.y>=this.min.y&&t.min.y<=this.max.y&&t.max.z>=this.min.z&&t.min.z<=this.max.z}intersectsSphere(t){return this.clampPoint(t.center,oi),oi.distanceToSquared(t.center)<=t.radius*t.radius}intersectsPlane(t){let e,n;return t.normal.x>0?(e=t.normal.x*this.min.x,n=t.normal.x*this.max.x):(e=t.normal.x*this.max.x,n=t.normal.x*this.min.x),t.normal.y>0?(e+=t.normal.y*this.min.y,n+=t.normal.y*this.max.y):(e+=t.normal.y*this.max.y,n+=t.normal.y*this.min.y),t.normal.z>0?(e+=t.normal.z*this.min.z,n+=t.normal.z*this.max.z):(e+=t.normal.z*this.max.z,n+=t.normal.z*this.min.z),e<=-t.constant&&n>=-t.constant}intersectsTriangle(t){if(this.isEmpty())return!1;this.getCenter(oa),Xa.subVectors(this.max,oa),rr.subVectors(t.a,oa),ar.subVectors(t.b,oa),or.subVectors(t.c,oa),Ki.subVectors(ar,rr),$i.subVectors(or,ar),xs.subVectors(rr,or);let e=[0,-Ki.z,Ki.y,0,-$i.z,$i.y,0,-xs.z,xs.y,Ki.z,0,-Ki.x,$i.z,0,-$i.x,xs.z,0,-xs.x,-Ki.y,Ki.x,0,-$i.y,$i.x,0,-xs.y,xs.x,0];return!Nl(e,rr,ar,or,Xa)||(e=[1,0,0,0,1,0,0,0,1],!Nl(e,rr,ar,or,Xa))?!1:(qa.crossVectors(Ki,$i),e=[qa.x,qa.y,qa.z],Nl(e,rr,ar,or,Xa))}clampPoint(t,e){return e.copy(t).clamp(this.min,this.max)}distanceToPoint(t){return this.clampPoint(t,oi).distanceTo(t)}getBoundingSphere(t){return this.isEmpty()?t.makeEmpty():(this.getCenter(t.center),t.radius=this.getSize(oi).length()*.5),t}intersect(t){return this.min.max(t.min),this.max.min(t.max),this.isEmpty()&&this.makeEmpty(),this}union(t){return this.min.min(t.min),this.max.max(t.max),this}applyMatrix4(t){return this.isEmpty()?this:(Di[0].set(this.min.x,this.min.y,this.min.z).applyMatrix4(t),Di[1].set(this.min.x,this.min.y,this.max.z).applyMatrix4(t),Di[2].set(this.min.x,this.max.y,this.min.z).applyMatrix4(t),Di[3].set(this.min.x,this.max.y,this.max.z).applyMatrix4(t),Di[4].set(this.max.x,this.min.y,this.min.z).applyMatrix4(t),Di[5].set(this.max.x,this.min.y,this.max.z).applyMatrix4(t),Di[6].set(this.max.x,this.max.y,this.min.z).applyMatrix4(t),Di[7].set(this.max.x,this.max.y,this.max.z).applyMatrix4(t),this.setFromPoints(Di),this)}translate(t){return this.min.add(t),this.max.add(t),this}equals(t){return t.min.equals(this.min)&&t.max.equals(this.max)}}const Di=[new j,new j,new j,new j,new j,new j,new j,new j],oi=new j,Wa=new La,rr=new j,ar=new j,or=new j,Ki=new j,$i=new j,xs=new j,oa=new j,Xa=new j,qa=new j,Ms=new j;function Nl(i,t,e,n,s){for(let r=0,a=i.length-3;r<=a;r+=3){Ms.fromArray(i,r);const o=s.x*Math.abs(Ms.x)+s.y*Math.abs(Ms.y)+s.z*Math.abs(Ms.z),l=t.dot(Ms),c=e.dot(Ms),u=n.dot(Ms);if(Math.max(-Math.max(l,c,u),Math.min(l,c,u))>o)return!1}return!0}const F_=new La,la=new j,kl=new j;class el{constructor(t=new j,e=-1){this.isSphere=!0,this.center=t,this.radius=e}set(t,e){return this.center.copy(t),this.radius=e,this}setFromPoints(t,e){const n=this.center;e!==void 0?n.copy(e):F_.setFromPoints(t).getCenter(n);let s=0;for(let r=0,a=t.length;r<a;r++)s=Math.max(s,n.distanceToSquared(t[r]));return this.radius=Math.sqrt(s),this}copy(t){return this.center.copy(t.center),this.radius=t.radius,this}isEmpty(){return this.radius<0}makeEmpty(){return this.center.set(0,0,0),this.radius=-1,this}containsPoint(t){return t.distanceToSquared(this.center)<=this.radius*this.radius}distanceToPoint(t){return t.distanceTo(this.center)-this.radius}intersectsSphere(t){const e=this.radius+t.radius;return t.center.distanceToSquared(this.center)<=e*e}intersectsBox(t){return t.intersectsSphere(this)}intersectsPlane(t){return Math.abs(t.distanceToPoint(this.center))<=this.radius}clampPoint(t,e){const n=this.center.distanceToSquared(t);return e.copy(t),n>this.radius*this.radius&&(e.sub(this.center).normalize(),e.multiplyScalar(this.radius).add(this.center)),e}getBoundingBox(t){return this.isEmpty()?(t.makeEmpty(),t):(t.set(this.center,this.center),t.expandByScalar(this.radius),t)}applyMatrix4(t){return this.center.applyMatrix4(t),this.radius=this.radius*t.getMaxScaleOnAxis(),this}translate(t){return this.center.add(t),this}expandByPoint(t){if(this.isEmpty())return this.center.copy(t),this.radius=0,this;la.subVectors(t,this.center);const e=la.lengthSq();if(e>this.radius*this.radius){const n=Math.sqrt(e),s=(n-this.radius)*.5;this.center.addScaledVector(la,s/n),this.radius+=s}return this}union(t){return t.isEmpty()?this:this.isEmpty()?(this.copy(t),this):(this.center.equals(t.center)===!0?this.radius=Math.max(this.radius,t.radius):(kl.subVectors(t.center,this.center).setLength(t.radius),this.expandByPoint(la.copy(t.center).add(kl)),this.expandByPoint(la.copy(t.center).sub(kl))),this)}equals(t){return t.center.equals(this.center)&&t.radius===this.radius}clone(){return new this.constructor().copy(this)}}const Ii=new j,Ol=new j,Ya=new j,Zi=new j,Fl=new j,ja=new j,Bl=new j;class Fh{constructor(t=new j,e=new j(0,0,-1)){this.origin=t,this.direction=e}set(t,e){return this.origin.copy(t),this.direction.copy(e),this}copy(t){return this.origin.copy(t.origin),this.direction.copy(t.direction),this}at(t,e){return e.copy(this.origin).addScaledVector(this.direction,t)}lookAt(t){return this.direction.copy(t).sub(this.origin).normalize(),this}recast(t){return this.origin.copy(this.at(t,Ii)),this}closestPointToPoint(t,e){e.subVectors(t,this.origin);const n=e.dot(this.direction);return n<0?e.copy(this.origin):e.copy(this.origin).addScaledVector(this.direction,n)}distanceToPoint(t){return Math.sqrt(this.distanceSqToPoint(t))}distanceSqToPoint(t){const e=Ii.subVectors(t,this.origin).dot(this.direction);return e<0?this.origin.distanceToSquared(t):(Ii.copy(this.origin).addScaledVector(this.direction,e),Ii.distanceToSquared(t))}distanceSqToSegment(t,e,n,s){Ol.copy(t).add(e).multiplyScalar(.5),Ya.copy(e).sub(t).normalize(),Zi.copy(this.origin).sub(Ol);const r=t.distanceTo(e)*.5,a=-this.direction.dot(Ya),o=Zi.dot(this.direction),l=-Zi.dot(Ya),c=Zi.lengthSq(),u=Math.abs(1-a*a);let f,h,_,x;if(u>0)if(f=a*l-o,h=a*o-l,x=r*u,f>=0)if(h>=-x)if(h<=x){const M=1/u;f*=M,h*=M,_=f*(f+a*h+2*o)+h*(a*f+h+2*l)+c}else h=r,f=Math.max(0,-(a*h+o)),_=-f*f+h*(h+2*l)+c;else h=-r,f=Math.max(0,-(a*h+o)),_=-f*f+h*(h+2*l)+c;else h<=-x?(f=Math.max(0,-(-a*r+o)),h=f>0?-r:Math.min(Math.max(-r,-l),r),_=-f*f+h*(h+2*l)+c):h<=x?(f=0,h=Math.min(Math.max(-r,-l),r),_=h*(h+2*l)+c):(f=Math.max(0,-(a*r+o)),h=f>0?r:Math.min(Math.max(-r,-l),r),_=-f*f+h*(h+2*l)+c);else h=a>0?-r:r,f=Math.max(0,-(a*h+o)),_=-f*f+h*(h+2*l)+c;return n&&n.copy(this.origin).addScaledVector(this.direction,f),s&&s.copy(Ol).addScaledVector(Ya,h),_}intersectSphere(t,e){Ii.subVectors(t.center,this.origin);const n=Ii.dot(this.direction),s=Ii.dot(Ii)-n*n,r=t.radius*t.radius;if(s>r)return null;const a=Math.sqrt(r-s),o=n-a,l=n+a;return l<0?null:o<0?this.at(l,e):this.at(o,e)}intersectsSphere(t){return this.distanceSqToPoint(t.center)<=t.radius*t.radius}distanceToPlane(t){const e=t.normal.dot(this.direction);if(e===0)return t.distanceToPoint(this.origin)===0?0:null;const n=-(this.origin.dot(t.normal)+t.constant)/e;return n>=0?n:null}intersectPlane(t,e){const n=this.distanceToPlane(t);return n===null?null:this.at(n,e)}intersectsPlane(t){const e=t.distanceToPoint(this.origin);return e===0||t.normal.dot(this.direction)*e<0}intersectBox(t,e){let n,s,r,a,o,l;const c=1/this.direction.x,u=1/this.direction.y,f=1/this.direction.z,h=this.origin;return c>=0?(n=(t.min.x-h.x)*c,s=(t.max.x-h.x)*c):(n=(t.max.x-h.x)*c,s=(t.min.x-h.x)*c),u>=0?(r=(t.min.y-h.y)*u,a=(t.max.y-h.y)*u):(r=(t.max.y-h.y)*u,a=(t.min.y-h.y)*u),n>a||r>s||((r>n||isNaN(n))&&(n=r),(a<s||isNaN(s))&&(s=a),f>=0?(o=(t.min.z-h.z)*f,l=(t.max.z-h.z)*f):(o=(t.max.z-h.z)*f,l=(t.min.z-h.z)*f),n>l||o>s)||((o>n||n!==n)&&(n=o),(l<s||s!==s)&&(s=l),s<0)?null:this.at(n>=0?n:s,e)}intersectsBox(t){return this.intersectBox(t,Ii)!==null}intersectTriangle(t,e,n,s,r){Fl.subVectors(e,t),ja.subVectors(n,t),Bl.crossVectors(Fl,ja);let a=this.direction.dot(Bl),o;if(a>0){if(s)return null;o=1}else if(a<0)o=-1,a=-a;else return null;Zi.subVectors(this.origin,t);const l=o*this.direction.dot(ja.crossVectors(Zi,ja));if(l<0)return null;const c=o*this.direction.dot(Fl.cross(Zi));if(c<0||l+c>a)return null;const u=-o*Zi.dot(Bl);return u<0?null:this.at(u/a,r)}applyMatrix4(t){return this.origin.applyMatrix4(t),this.direction.transformDirection(t),this}equals(t){return t.origin.equals(this.origin)&&t.direction.equals(this.direction)}clone(){return new this.constructor().copy(this)}}class Ge{constructor(t,e,n,s,r,a,o,l,c,u,f,h,_,x,M,p){Ge.prototype.isMatrix4=!0,this.elements=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],t!==void 0&&this.set(t,e,n,s,r,a,o,l,c,u,f,h,_,x,M,p)}set(t,e,n,s,r,a,o,l,c,u,f,h,_,x,M,p){const d=this.elements;return d[0]=t,d[4]=e,d[8]=n,d[12]=s,d[1]=r,d[5]=a,d[9]=o,d[13]=l,d[2]=c,d[6]=u,d[10]=f,d[14]=h,d[3]=_,d[7]=x,d[11]=M,d[15]=p,this}identity(){return this.set(1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1),this}clone(){return new Ge().fromArray(this.elements)}copy(t){const e=this.elements,n=t.elements;return e[0]=n[0],e[1]=n[1],e[2]=n[2],e[3]=n[3],e[4]=n[4],e[5]=n[5],e[6]=n[6],e[7]=n[7],e[8]=n[8],e[9]=n[9],e[10]=n[10],e[11]=n[11],e[12]=n[12],e[13]=n[13],e[14]=n[14],e[15]=n[15],this}copyPosition(t){const e=this.elements,n=t.elements;return e[12]=n[12],e[13]=n[13],e[14]=n[14],this}setFromMatrix3(t){const e=t.elements;return this.set(e[0],e[3],e[6],0,e[1],e[4],e[7],0,e[2],e[5],e[8],0,0,0,0,1),this}extractBasis(t,e,n){return t.setFromMatrixColumn(this,0),e.setFromMatrixColumn(this,1),n.setFromMatrixColumn(this,2),this}makeBasis(t,e,n){return this.set(t.x,e.x,n.x,0,t.y,e.y,n.y,0,t.z,e.z,n.z,0,0,0,0,1),this}extractRotation(t){const e=this.elements,n=t.elements,s=1/lr.setFromMatrixColumn(t,0).length(),r=1/lr.setFromMatrixColumn(t,1).length(),a=1/lr.setFromMatrixColumn(t,2).length();return e[0]=n[0]*s,e[1]=n[1]*s,e[2]=n[2]*s,e[3]=0,e[4]=n[4]*r,e[5]=n[5]*r,e[6]=n[6]*r,e[7]=0,e[8]=n[8]*a,e[9]=n[9]*a,e[10]=n[10]*a,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromEuler(t){const e=this.elements,n=t.x,s=t.y,r=t.z,a=Math.cos(n),o=Math.sin(n),l=Math.cos(s),c=Math.sin(s),u=Math.cos(r),f=Math.sin(r);if(t.order==="XYZ"){const h=a*u,_=a*f,x=o*u,M=o*f;e[0]=l*u,e[4]=-l*f,e[8]=c,e[1]=_+x*c,e[5]=h-M*c,e[9]=-o*l,e[2]=M-h*c,e[6]=x+_*c,e[10]=a*l}else if(t.order==="YXZ"){const h=l*u,_=l*f,x=c*u,M=c*f;e[0]=h+M*o,e[4]=x*o-_,e[8]=a*c,e[1]=a*f,e[5]=a*u,e[9]=-o,e[2]=_*o-x,e[6]=M+h*o,e[10]=a*l}else if(t.order==="ZXY"){const h=l*u,_=l*f,x=c*u,M=c*f;e[0]=h-M*o,e[4]=-a*f,e[8]=x+_*o,e[1]=_+x*o,e[5]=a*u,e[9]=M-h*o,e[2]=-a*c,e[6]=o,e[10]=a*l}else if(t.order==="ZYX"){const h=a*u,_=a*f,x=o*u,M=o*f;e[0]=l*u,e[4]=x*c-_,e[8]=h*c+M,e[1]=l*f,e[5]=M*c+h,e[9]=_*c-x,e[2]=-c,e[6]=o*l,e[10]=a*l}else if(t.order==="YZX"){const h=a*l,_=a*c,x=o*l,M=o*c;e[0]=l*u,e[4]=M-h*f,e[8]=x*f+_,e[1]=f,e[5]=a*u,e[9]=-o*u,e[2]=-c*u,e[6]=_*f+x,e[10]=h-M*f}else if(t.order==="XZY"){const h=a*l,_=a*c,x=o*l,M=o*c;e[0]=l*u,e[4]=-f,e[8]=c*u,e[1]=h*f+M,e[5]=a*u,e[9]=_*f-x,e[2]=x*f-_,e[6]=o*u,e[10]=M*f+h}return e[3]=0,e[7]=0,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromQuaternion(t){return this.compose(B_,t,z_)}lookAt(t,e,n){const s=this.elements;return Bn.subVectors(t,e),Bn.lengthSq()===0&&(Bn.z=1),Bn.normalize(),Ji.crossVectors(n,Bn),Ji.lengthSq()===0&&(Math.abs(n.z)===1?Bn.x+=1e-4:Bn.z+=1e-4,Bn.normalize(),Ji.crossVectors(n,Bn)),Ji.normalize(),Ka.crossVectors(Bn,Ji),s[0]=Ji.x,s[4]=Ka.x,s[8]=Bn.x,s[1]=Ji.y,s[5]=Ka.y,s[9]=Bn.y,s[2]=Ji.z,s[6]=Ka.z,s[10]=Bn.z,this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){const n=t.elements,s=e.elements,r=this.elements,a=n[0],o=n[4],l=n[8],c=n[12],u=n[1],f=n[5],h=n[9],_=n[13],x=n[2],M=n[6],p=n[10],d=n[14],C=n[3],b=n[7],R=n[11],D=n[15],A=s[0],y=s[4],P=s[8],O=s[12],g=s[1],m=s[5],E=s[9],N=s[13],F=s[2],B=s[6],G=s[10],$=s[14],Q=s[3],dt=s[7],ct=s[11],gt=s[15];return r[0]=a*A+o*g+l*F+c*Q,r[4]=a*y+o*m+l*B+c*dt,r[8]=a*P+o*E+l*G+c*ct,r[12]=a*O+o*N+l*$+c*gt,r[1]=u*A+f*g+h*F+_*Q,r[5]=u*y+f*m+h*B+_*dt,r[9]=u*P+f*E+h*G+_*ct,r[13]=u*O+f*N+h*$+_*gt,r[2]=x*A+M*g+p*F+d*Q,r[6]=x*y+M*m+p*B+d*dt,r[10]=x*P+M*E+p*G+d*ct,r[14]=x*O+M*N+p*$+d*gt,r[3]=C*A+b*g+R*F+D*Q,r[7]=C*y+b*m+R*B+D*dt,r[11]=C*P+b*E+R*G+D*ct,r[15]=C*O+b*N+R*$+D*gt,this}multiplyScalar(t){const e=this.elements;return e[0]*=t,e[4]*=t,e[8]*=t,e[12]*=t,e[1]*=t,e[5]*=t,e[9]*=t,e[13]*=t,e[2]*=t,e[6]*=t,e[10]*=t,e[14]*=t,e[3]*=t,e[7]*=t,e[11]*=t,e[15]*=t,this}determinant(){const t=this.elements,e=t[0],n=t[4],s=t[8],r=t[12],a=t[1],o=t[5],l=t[9],c=t[13],u=t[2],f=t[6],h=t[10],_=t[14],x=t[3],M=t[7],p=t[11],d=t[15];return x*(+r*l*f-s*c*f-r*o*h+n*c*h+s*o*_-n*l*_)+M*(+e*l*_-e*c*h+r*a*h-s*a*_+s*c*u-r*l*u)+p*(+e*c*f-e*o*_-r*a*f+n*a*_+r*o*u-n*c*u)+d*(-s*o*u-e*l*f+e*o*h+s*a*f-n*a*h+n*l*u)}transpose(){const t=this.elements;let e;return e=t[1],t[1]=t[4],t[4]=e,e=t[2],t[2]=t[8],t[8]=e,e=t[6],t[6]=t[9],t[9]=e,e=t[3],t[3]=t[12],t[12]=e,e=t[7],t[7]=t[13],t[13]=e,e=t[11],t[11]=t[14],t[14]=e,this}setPosition(t,e,n){const s=this.elements;return t.isVector3?(s[12]=t.x,s[13]=t.y,s[14]=t.z):(s[12]=t,s[13]=e,s[14]=n),this}invert(){const t=this.elements,e=t[0],n=t[1],s=t[2],r=t[3],a=t[4],o=t[5],l=t[6],c=t[7],u=t[8],f=t[9],h=t[10],_=t[11],x=t[12],M=t[13],p=t[14],d=t[15],C=f*p*c-M*h*c+M*l*_-o*p*_-f*l*d+o*h*d,b=x*h*c-u*p*c-x*l*_+a*p*_+u*l*d-a*h*d,R=u*M*c-x*f*c+x*o*_-a*M*_-u*o*d+a*f*d,D=x*f*l-u*M*l-x*o*h+a*M*h+u*o*p-a*f*p,A=e*C+n*b+s*R+r*D;if(A===0)return this.set(0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0);const y=1/A;return t[0]=C*y,t[1]=(M*h*r-f*p*r-M*s*_+n*p*_+f*s*d-n*h*d)*y,t[2]=(o*p*r-M*l*r+M*s*c-n*p*c-o*s*d+n*l*d)*y,t[3]=(f*l*r-o*h*r-f*s*c+n*h*c+o*s*_-n*l*_)*y,t[4]=b*y,t[5]=(u*p*r-x*h*r+x*s*_-e*p*_-u*s*d+e*h*d)*y,t[6]=(x*l*r-a*p*r-x*s*c+e*p*c+a*s*d-e*l*d)*y,t[7]=(a*h*r-u*l*r+u*s*c-e*h*c-a*s*_+e*l*_)*y,t[8]=R*y,t[9]=(x*f*r-u*M*r-x*n*_+e*M*_+u*n*d-e*f*d)*y,t[10]=(a*M*r-x*o*r+x*n*c-e*M*c-a*n*d+e*o*d)*y,t[11]=(u*o*r-a*f*r-u*n*c+e*f*c+a*n*_-e*o*_)*y,t[12]=D*y,t[13]=(u*M*s-x*f*s+x*n*h-e*M*h-u*n*p+e*f*p)*y,t[14]=(x*o*s-a*M*s-x*n*l+e*M*l+a*n*p-e*o*p)*y,t[15]=(a*f*s-u*o*s+u*n*l-e*f*l-a*n*h+e*o*h)*y,this}scale(t){const e=this.elements,n=t.x,s=t.y,r=t.z;return e[0]*=n,e[4]*=s,e[8]*=r,e[1]*=n,e[5]*=s,e[9]*=r,e[2]*=n,e[6]*=s,e[10]*=r,e[3]*=n,e[7]*=s,e[11]*=r,this}getMaxScaleOnAxis(){const t=this.elements,e=t[0]*t[0]+t[1]*t[1]+t[2]*t[2],n=t[4]*t[4]+t[5]*t[5]+t[6]*t[6],s=t[8]*t[8]+t[9]*t[9]+t[10]*t[10];return Math.sqrt(Math.max(e,n,s))}makeTranslation(t,e,n){return t.isVector3?this.set(1,0,0,t.x,0,1,0,t.y,0,0,1,t.z,0,0,0,1):this.set(1,0,0,t,0,1,0,e,0,0,1,n,0,0,0,1),this}makeRotationX(t){const e=Math.cos(t),n=Math.sin(t);return this.set(1,0,0,0,0,e,-n,0,0,n,e,0,0,0,0,1),this}makeRotationY(t){const e=Math.cos(t),n=Math.sin(t);return this.set(e,0,n,0,0,1,0,0,-n,0,e,0,0,0,0,1),this}makeRotationZ(t){const e=Math.cos(t),n=Math.sin(t);return this.set(e,-n,0,0,n,e,0,0,0,0,1,0,0,0,0,1),this}makeRotationAxis(t,e){const n=Math.cos(e),s=Math.sin(e),r=1-n,a=t.x,o=t.y,l=t.z,c=r*a,u=r*o;return this.set(c*a+n,c*o-s*l,c*l+s*o,0,c*o+s*l,u*o+n,u*l-s*a,0,c*l-s*o,u*l+s*a,r*l*l+n,0,0,0,0,1),this}makeScale(t,e,n){return this.set(t,0,0,0,0,e,0,0,0,0,n,0,0,0,0,1),this}makeShear(t,e,n,s,r,a){return this.set(1,n,r,0,t,1,a,0,e,s,1,0,0,0,0,1),this}compose(t,e,n){const s=this.elements,r=e._x,a=e._y,o=e._z,l=e._w,c=r+r,u=a+a,f=o+o,h=r*c,_=r*u,x=r*f,M=a*u,p=a*f,d=o*f,C=l*c,b=l*u,R=l*f,D=n.x,A=n.y,y=n.z;return s[0]=(1-(M+d))*D,s[1]=(_+R)*D,s[2]=(x-b)*D,s[3]=0,s[4]=(_-R)*A,s[5]=(1-(h+d))*A,s[6]=(p+C)*A,s[7]=0,s[8]=(x+b)*y,s[9]=(p-C)*y,s[10]=(1-(h+M))*y,s[11]=0,s[12]=t.x,s[13]=t.y,s[14]=t.z,s[15]=1,this}decompose(t,e,n){const s=this.elements;let r=lr.set(s[0],s[1],s[2]).length();const a=lr.set(s[4],s[5],s[6]).length(),o=lr.set(s[8],s[9],s[10]).length();this.determinant()<0&&(r=-r),t.x=s[12],t.y=s[13],t.z=s[14],li.copy(this);const c=1/r,u=1/a,f=1/o;return li.elements[0]*=c,li.elements[1]*=c,li.elements[2]*=c,li.elements[4]*=u,li.elements[5]*=u,li.elements[6]*=u,li.elements[8]*=f,li.elements[9]*=f,li.elements[10]*=f,e.setFromRotationMatrix(li),n.x=r,n.y=a,n.z=o,this}makePerspective(t,e,n,s,r,a,o=zi){const l=this.elements,c=2*r/(e-t),u=2*r/(n-s),f=(e+t)/(e-t),h=(n+s)/(n-s);let _,x;if(o===zi)_=-(a+r)/(a-r),x=-2*a*r/(a-r);else if(o===Vo)_=-a/(a-r),x=-a*r/(a-r);else throw new Error("THREE.Matrix4.makePerspective(): Invalid coordinate system: "+o);return l[0]=c,l[4]=0,l[8]=f,l[12]=0,l[1]=0,l[5]=u,l[9]=h,l[13]=0,l[2]=0,l[6]=0,l[10]=_,l[14]=x,l[3]=0,l[7]=0,l[11]=-1,l[15]=0,this}makeOrthographic(t,e,n,s,r,a,o=zi){const l=this.elements,c=1/(e-t),u=1/(n-s),f=1/(a-r),h=(e+t)*c,_=(n+s)*u;let x,M;if(o===zi)x=(a+r)*f,M=-2*f;else if(o===Vo)x=r*f,M=-1*f;else throw new Error("THREE.Matrix4.makeOrthographic(): Invalid coordinate system: "+o);return l[0]=2*c,l[4]=0,l[8]=0,l[12]=-h,l[1]=0,l[5]=2*u,l[9]=0,l[13]=-_,l[2]=0,l[6]=0,l[10]=M,l[14]=-x,l[3]=0,l[7]=0,l[11]=0,l[15]=1,this}equals(t){const e=this.elements,n=t.elements;for(let s=0;s<16;s++)if(e[s]!==n[s])return!1;return!0}fromArray(t,e=0){for(let n=0;n<16;n++)this.elements[n]=t[n+e];return this}toArray(t=[],e=0){const n=this.elements;return t[e]=n[0],t[e+1]=n[1],t[e+2]=n[2],t[e+3]=n[3],t[e+4]=n[4],t[e+5]=n[5],t[e+6]=n[6],t[e+7]=n[7],t[e+8]=n[8],t[e+9]=n[9],t[e+10]=n[10],t[e+11]=n[11],t[e+12]=n[12],t[e+13]=n[13],t[e+14]=n[14],t[e+15]=n[15],t}}const lr=new j,li=new Ge,B_=new j(0,0,0),z_=new j(1,1,1),Ji=new j,Ka=new j,Bn=new j,ju=new Ge,Ku=new Bs;class Ai{constructor(t=0,e=0,n=0,s=Ai.DEFAULT_ORDER){this.isEuler=!0,this._x=t,this._y=e,this._z=n,this._order=s}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get order(){return this._order}set order(t){this._order=t,this._onChangeCallback()}set(t,e,n,s=this._order){return this._x=t,this._y=e,this._z=n,this._order=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._order)}copy(t){return this._x=t._x,this._y=t._y,this._z=t._z,this._order=t._order,this._onChangeCallback(),this}setFromRotationMatrix(t,e=this._order,n=!0){const s=t.elements,r=s[0],a=s[4],o=s[8],l=s[1],c=s[5],u=s[9],f=s[2],h=s[6],_=s[10];switch(e){case"XYZ":this._y=Math.asin(Pn(o,-1,1)),Math.abs(o)<.9999999?(this._x=Math.atan2(-u,_),this._z=Math.atan2(-a,r)):(this._x=Math.atan2(h,c),this._z=0);break;case"YXZ":this._x=Math.asin(-Pn(u,-1,1)),Math.abs(u)<.9999999?(this._y=Math.atan2(o,_),this._z=Math.atan2(l,c)):(this._y=Math.atan2(-f,r),this._z=0);break;case"ZXY":this._x=Math.asin(Pn(h,-1,1)),Math.abs(h)<.9999999?(this._y=Math.atan2(-f,_),this._z=Math.atan2(-a,c)):(this._y=0,this._z=Math.atan2(l,r));break;case"ZYX":this._y=Math.asin(-Pn(f,-1,1)),Math.abs(f)<.9999999?(this._x=Math.atan2(h,_),this._z=Math.atan2(l,r)):(this._x=0,this._z=Math.atan2(-a,c));break;case"YZX":this._z=Math.asin(Pn(l,-1,1)),Math.abs(l)<.9999999?(this._x=Math.atan2(-u,c),this._y=Math.atan2(-f,r)):(this._x=0,this._y=Math.atan2(o,_));break;case"XZY":this._z=Math.asin(-Pn(a,-1,1)),Math.abs(a)<.9999999?(this._x=Math.atan2(h,c),this._y=Math.atan2(o,r)):(this._x=Math.atan2(-u,_),this._y=0);break;default:console.warn("THREE.Euler: .setFromRotationMatrix() encountered an unknown order: "+e)}return this._order=e,n===!0&&this._onChangeCallback(),this}setFromQuaternion(t,e,n){return ju.makeRotationFromQuaternion(t),this.setFromRotationMatrix(ju,e,n)}setFromVector3(t,e=this._order){return this.set(t.x,t.y,t.z,e)}reorder(t){return Ku.setFromEuler(this),this.setFromQuaternion(Ku,t)}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._order===this._order}fromArray(t){return this._x=t[0],this._y=t[1],this._z=t[2],t[3]!==void 0&&(this._order=t[3]),this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._order,t}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._order}}Ai.DEFAULT_ORDER="XYZ";class pp{constructor(){this.mask=1}set(t){this.mask=(1<<t|0)>>>0}enable(t){this.mask|=1<<t|0}enableAll(){this.mask=-1}toggle(t){this.mask^=1<<t|0}disable(t){this.mask&=~(1<<t|0)}disableAll(){this.mask=0}test(t){return(this.mask&t.mask)!==0}isEnabled(t){return(this.mask&(1<<t|0))!==0}}let H_=0;const $u=new j,cr=new Bs,Ui=new Ge,$a=new j,ca=new j,G_=new j,V_=new Bs,Zu=new j(1,0,0),Ju=new j(0,1,0),Qu=new j(0,0,1),tf={type:"added"},W_={type:"removed"},hr={type:"childadded",child:null},zl={type:"childremoved",child:null};class an extends Hs{constructor(){super(),this.isObject3D=!0,Object.defineProperty(this,"id",{value:H_++}),this.uuid=cs(),this.name="",this.type="Object3D",this.parent=null,this.children=[],this.up=an.DEFAULT_UP.clone();const t=new j,e=new Ai,n=new Bs,s=new j(1,1,1);function r(){n.setFromEuler(e,!1)}function a(){e.setFromQuaternion(n,void 0,!1)}e._onChange(r),n._onChange(a),Object.defineProperties(this,{position:{configurable:!0,enumerable:!0,value:t},rotation:{configurable:!0,enumerable:!0,value:e},quaternion:{configurable:!0,enumerable:!0,value:n},scale:{configurable:!0,enumerable:!0,value:s},modelViewMatrix:{value:new Ge},normalMatrix:{value:new oe}}),this.matrix=new Ge,this.matrixWorld=new Ge,this.matrixAutoUpdate=an.DEFAULT_MATRIX_AUTO_UPDATE,this.matrixWorldAutoUpdate=an.DEFAULT_MATRIX_WORLD_AUTO_UPDATE,this.matrixWorldNeedsUpdate=!1,this.layers=new pp,this.visible=!0,this.castShadow=!1,this.receiveShadow=!1,this.frustumCulled=!0,this.renderOrder=0,this.animations=[],this.userData={}}onBeforeShadow(){}onAfterShadow(){}onBeforeRender(){}onAfterRender(){}applyMatrix4(t){this.matrixAutoUpdate&&this.updateMatrix(),this.matrix.premultiply(t),this.matrix.decompose(this.position,this.quaternion,this.scale)}applyQuaternion(t){return this.quaternion.premultiply(t),this}setRotationFromAxisAngle(t,e){this.quaternion.setFromAxisAngle(t,e)}setRotationFromEuler(t){this.quaternion.setFromEuler(t,!0)}setRotationFromMatrix(t){this.quaternion.setFromRotationMatrix(t)}setRotationFromQuaternion(t){this.quaternion.copy(t)}rotateOnAxis(t,e){return cr.setFromAxisAngle(t,e),this.quaternion.multiply(cr),this}rotateOnWorldAxis(t,e){return cr.setFromAxisAngle(t,e),this.quaternion.premultiply(cr),this}rotateX(t){return this.rotateOnAxis(Zu,t)}rotateY(t){return this.rotateOnAxis(Ju,t)}rotateZ(t){return this.rotateOnAxis(Qu,t)}translateOnAxis(t,e){return $u.copy(t).applyQuaternion(this.quaternion),this.position.add($u.multiplyScalar(e)),this}translateX(t){return this.translateOnAxis(Zu,t)}translateY(t){return this.translateOnAxis(Ju,t)}translateZ(t){return this.translateOnAxis(Qu,t)}localToWorld(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(this.matrixWorld)}worldToLocal(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(Ui.copy(this.matrixWorld).invert())}lookAt(t,e,n){t.isVector3?$a.copy(t):$a.set(t,e,n);const s=this.parent;this.updateWorldMatrix(!0,!1),ca.setFromMatrixPosition(this.matrixWorld),this.isCamera||this.isLight?Ui.lookAt(ca,$a,this.up):Ui.lookAt($a,ca,this.up),this.quaternion.setFromRotationMatrix(Ui),s&&(Ui.extractRotation(s.matrixWorld),cr.setFromRotationMatrix(Ui),this.quaternion.premultiply(cr.invert()))}add(t){if(arguments.length>1){for(let e=0;e<arguments.length;e++)this.add(arguments[e]);return this}return t===this?(console.error("THREE.Object3D.add: object can't be added as a child of itself.",t),this):(t&&t.isObject3D?(t.removeFromParent(),t.parent=this,this.children.push(t),t.dispatchEvent(tf),hr.child=t,this.dispatchEvent(hr),hr.child=null):console.error("THREE.Object3D.add: object not an instance of THREE.Object3D.",t),this)}remove(t){if(arguments.length>1){for(let n=0;n<arguments.length;n++)this.remove(arguments[n]);return this}const e=this.children.indexOf(t);return e!==-1&&(t.parent=null,this.children.splice(e,1),t.dispatchEvent(W_),zl.child=t,this.dispatchEvent(zl),zl.child=null),this}removeFromParent(){const t=this.parent;return t!==null&&t.remove(this),this}clear(){return this.remove(...this.children)}attach(t){return this.updateWorldMatrix(!0,!1),Ui.copy(this.matrixWorld).invert(),t.parent!==null&&(t.parent.updateWorldMatrix(!0,!1),Ui.multiply(t.parent.matrixWorld)),t.applyMatrix4(Ui),t.removeFromParent(),t.parent=this,this.children.push(t),t.updateWorldMatrix(!1,!0),t.dispatchEvent(tf),hr.child=t,this.dispatchEvent(hr),hr.child=null,this}getObjectById(t){return this.getObjectByProperty("id",t)}getObjectByName(t){return this.getObjectByProperty("name",t)}getObjectByProperty(t,e){if(this[t]===e)return this;for(let n=0,s=this.children.length;n<s;n++){const a=this.children[n].getObjectByProperty(t,e);if(a!==void 0)return a}}getObjectsByProperty(t,e,n=[]){this[t]===e&&n.push(this);const s=this.children;for(let r=0,a=s.length;r<a;r++)s[r].getObjectsByProperty(t,e,n);return n}getWorldPosition(t){return this.updateWorldMatrix(!0,!1),t.setFromMatrixPosition(this.matrixWorld)}getWorldQuaternion(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(ca,t,G_),t}getWorldScale(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(ca,V_,t),t}getWorldDirection(t){this.updateWorldMatrix(!0,!1);const e=this.matrixWorld.elements;return t.set(e[8],e[9],e[10]).normalize()}raycast(){}traverse(t){t(this);const e=this.children;for(let n=0,s=e.length;n<s;n++)e[n].traverse(t)}traverseVisible(t){if(this.visible===!1)return;t(this);const e=this.children;for(let n=0,s=e.length;n<s;n++)e[n].traverseVisible(t)}traverseAncestors(t){const e=this.parent;e!==null&&(t(e),e.traverseAncestors(t))}updateMatrix(){this.matrix.compose(this.position,this.quaternion,this.scale),this.matrixWorldNeedsUpdate=!0}updateMatrixWorld(t){this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||t)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,t=!0);const e=this.children;for(let n=0,s=e.length;n<s;n++)e[n].updateMatrixWorld(t)}updateWorldMatrix(t,e){const n=this.parent;if(t===!0&&n!==null&&n.updateWorldMatrix(!0,!1),this.matrixAutoUpdate&&this.updateMatrix(),this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),e===!0){const s=this.children;for(let r=0,a=s.length;r<a;r++)s[r].updateWorldMatrix(!1,!0)}}toJSON(t){const e=t===void 0||typeof t=="string",n={};e&&(t={geometries:{},materials:{},textures:{},images:{},shapes:{},skeletons:{},animations:{},nodes:{}},n.metadata={version:4.6,type:"Object",generator:"Object3D.toJSON"});const s={};s.uuid=this.uuid,s.type=this.type,this.name!==""&&(s.name=this.name),this.castShadow===!0&&(s.castShadow=!0),this.receiveShadow===!0&&(s.receiveShadow=!0),this.visible===!1&&(s.visible=!1),this.frustumCulled===!1&&(s.frustumCulled=!1),this.renderOrder!==0&&(s.renderOrder=this.renderOrder),Object.keys(this.userData).length>0&&(s.userData=this.userData),s.layers=this.layers.mask,s.matrix=this.matrix.toArray(),s.up=this.up.toArray(),this.matrixAutoUpdate===!1&&(s.matrixAutoUpdate=!1),this.isInstancedMesh&&(s.type="InstancedMesh",s.count=this.count,s.instanceMatrix=this.instanceMatrix.toJSON(),this.instanceColor!==null&&(s.instanceColor=this.instanceColor.toJSON())),this.isBatchedMesh&&(s.type="BatchedMesh",s.perObjectFrustumCulled=this.perObjectFrustumCulled,s.sortObjects=this.sortObjects,s.drawRanges=this._drawRanges,s.reservedRanges=this._reservedRanges,s.visibility=this._visibility,s.active=this._active,s.bounds=this._bounds.map(o=>({boxInitialized:o.boxInitialized,boxMin:o.box.min.toArray(),boxMax:o.box.max.toArray(),sphereInitialized:o.sphereInitialized,sphereRadius:o.sphere.radius,sphereCenter:o.sphere.center.toArray()})),s.maxInstanceCount=this._maxInstanceCount,s.maxVertexCount=this._maxVertexCount,s.maxIndexCount=this._maxIndexCount,s.geometryInitialized=this._geometryInitialized,s.geometryCount=this._geometryCount,s.matricesTexture=this._matricesTexture.toJSON(t),this._colorsTexture!==null&&(s.colorsTexture=this._colorsTexture.toJSON(t)),this.boundingSphere!==null&&(s.boundingSphere={center:s.boundingSphere.center.toArray(),radius:s.boundingSphere.radius}),this.boundingBox!==null&&(s.boundingBox={min:s.boundingBox.min.toArray(),max:s.boundingBox.max.toArray()}));function r(o,l){return o[l.uuid]===void 0&&(o[l.uuid]=l.toJSON(t)),l.uuid}if(this.isScene)this.background&&(this.background.isColor?s.background=this.background.toJSON():this.background.isTexture&&(s.background=this.background.toJSON(t).uuid)),this.environment&&this.environment.isTexture&&this.environment.isRenderTargetTexture!==!0&&(s.environment=this.environment.toJSON(t).uuid);else if(this.isMesh||this.isLine||this.isPoints){s.geometry=r(t.geometries,this.geometry);const o=this.geometry.parameters;if(o!==void 0&&o.shapes!==void 0){const l=o.shapes;if(Array.isArray(l))for(let c=0,u=l.length;c<u;c++){const f=l[c];r(t.shapes,f)}else r(t.shapes,l)}}if(this.isSkinnedMesh&&(s.bindMode=this.bindMode,s.bindMatrix=this.bindMatrix.toArray(),this.skeleton!==void 0&&(r(t.skeletons,this.skeleton),s.skeleton=this.skeleton.uuid)),this.material!==void 0)if(Array.isArray(this.material)){const o=[];for(let l=0,c=this.material.length;l<c;l++)o.push(r(t.materials,this.material[l]));s.material=o}else s.material=r(t.materials,this.material);if(this.children.length>0){s.children=[];for(let o=0;o<this.children.length;o++)s.children.push(this.children[o].toJSON(t).object)}if(this.animations.length>0){s.animations=[];for(let o=0;o<this.animations.length;o++){const l=this.animations[o];s.animations.push(r(t.animations,l))}}if(e){const o=a(t.geometries),l=a(t.materials),c=a(t.textures),u=a(t.images),f=a(t.shapes),h=a(t.skeletons),_=a(t.animations),x=a(t.nodes);o.length>0&&(n.geometries=o),l.length>0&&(n.materials=l),c.length>0&&(n.textures=c),u.length>0&&(n.images=u),f.length>0&&(n.shapes=f),h.length>0&&(n.skeletons=h),_.length>0&&(n.animations=_),x.length>0&&(n.nodes=x)}return n.object=s,n;function a(o){const l=[];for(const c in o){const u=o[c];delete u.metadata,l.push(u)}return l}}clone(t){return new this.constructor().copy(this,t)}copy(t,e=!0){if(this.name=t.name,this.up.copy(t.up),this.position.copy(t.position),this.rotation.order=t.rotation.order,this.quaternion.copy(t.quaternion),this.scale.copy(t.scale),this.matrix.copy(t.matrix),this.matrixWorld.copy(t.matrixWorld),this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrixWorldAutoUpdate=t.matrixWorldAutoUpdate,this.matrixWorldNeedsUpdate=t.matrixWorldNeedsUpdate,this.layers.mask=t.layers.mask,this.visible=t.visible,this.castShadow=t.castShadow,this.receiveShadow=t.receiveShadow,this.frustumCulled=t.frustumCulled,this.renderOrder=t.renderOrder,this.animations=t.animations.slice(),this.userData=JSON.parse(JSON.stringify(t.userData)),e===!0)for(let n=0;n<t.children.length;n++){const s=t.children[n];this.add(s.clone())}return this}}an.DEFAULT_UP=new j(0,1,0);an.DEFAULT_MATRIX_AUTO_UPDATE=!0;an.DEFAULT_MATRIX_WORLD_AUTO_UPDATE=!0;const ci=new j,Ni=new j,Hl=new j,ki=new j,ur=new j,fr=new j,ef=new j,Gl=new j,Vl=new j,Wl=new j,Xl=new je,ql=new je,Yl=new je;class Vn{constructor(t=new j,e=new j,n=new j){this.a=t,this.b=e,this.c=n}static getNormal(t,e,n,s){s.subVectors(n,e),ci.subVectors(t,e),s.cross(ci);const r=s.lengthSq();return r>0?s.multiplyScalar(1/Math.sqrt(r)):s.set(0,0,0)}static getBarycoord(t,e,n,s,r){ci.subVectors(s,e),Ni.subVectors(n,e),Hl.subVectors(t,e);const a=ci.dot(ci),o=ci.dot(Ni),l=ci.dot(Hl),c=Ni.dot(Ni),u=Ni.dot(Hl),f=a*c-o*o;if(f===0)return r.set(0,0,0),null;const h=1/f,_=(c*l-o*u)*h,x=(a*u-o*l)*h;return r.set(1-_-x,x,_)}static containsPoint(t,e,n,s){return this.getBarycoord(t,e,n,s,ki)===null?!1:ki.x>=0&&ki.y>=0&&ki.x+ki.y<=1}static getInterpolation(t,e,n,s,r,a,o,l){return this.getBarycoord(t,e,n,s,ki)===null?(l.x=0,l.y=0,"z"in l&&(l.z=0),"w"in l&&(l.w=0),null):(l.setScalar(0),l.addScaledVector(r,ki.x),l.addScaledVector(a,ki.y),l.addScaledVector(o,ki.z),l)}static getInterpolatedAttribute(t,e,n,s,r,a){return Xl.setScalar(0),ql.setScalar(0),Yl.setScalar(0),Xl.fromBufferAttribute(t,e),ql.fromBufferAttribute(t,n),Yl.fromBufferAttribute(t,s),a.setScalar(0),a.addScaledVector(Xl,r.x),a.addScaledVector(ql,r.y),a.addScaledVector(Yl,r.z),a}static isFrontFacing(t,e,n,s){return ci.subVectors(n,e),Ni.subVectors(t,e),ci.cross(Ni).dot(s)<0}set(t,e,n){return this.a.copy(t),this.b.copy(e),this.c.copy(n),this}setFromPointsAndIndices(t,e,n,s){return this.a.copy(t[e]),this.b.copy(t[n]),this.c.copy(t[s]),this}setFromAttributeAndIndices(t,e,n,s){return this.a.fromBufferAttribute(t,e),this.b.fromBufferAttribute(t,n),this.c.fromBufferAttribute(t,s),this}clone(){return new this.constructor().copy(this)}copy(t){return this.a.copy(t.a),this.b.copy(t.b),this.c.copy(t.c),this}getArea(){return ci.subVectors(this.c,this.b),Ni.subVectors(this.a,this.b),ci.cross(Ni).length()*.5}getMidpoint(t){return t.addVectors(this.a,this.b).add(this.c).multiplyScalar(1/3)}getNormal(t){return Vn.getNormal(this.a,this.b,this.c,t)}getPlane(t){return t.setFromCoplanarPoints(this.a,this.b,this.c)}getBarycoord(t,e){return Vn.getBarycoord(t,this.a,this.b,this.c,e)}getInterpolation(t,e,n,s,r){return Vn.getInterpolation(t,this.a,this.b,this.c,e,n,s,r)}containsPoint(t){return Vn.containsPoint(t,this.a,this.b,this.c)}isFrontFacing(t){return Vn.isFrontFacing(this.a,this.b,this.c,t)}intersectsBox(t){return t.intersectsTriangle(this)}closestPointToPoint(t,e){const n=this.a,s=this.b,r=this.c;let a,o;ur.subVectors(s,n),fr.subVectors(r,n),Gl.subVectors(t,n);const l=ur.dot(Gl),c=fr.dot(Gl);if(l<=0&&c<=0)return e.copy(n);Vl.subVectors(t,s);const u=ur.dot(Vl),f=fr.dot(Vl);if(u>=0&&f<=u)return e.copy(s);const h=l*f-u*c;if(h<=0&&l>=0&&u<=0)return a=l/(l-u),e.copy(n).addScaledVector(ur,a);Wl.subVectors(t,r);const _=ur.dot(Wl),x=fr.dot(Wl);if(x>=0&&_<=x)return e.copy(r);const M=_*c-l*x;if(M<=0&&c>=0&&x<=0)return o=c/(c-x),e.copy(n).addScaledVector(fr,o);const p=u*x-_*f;if(p<=0&&f-u>=0&&_-x>=0)return ef.subVectors(r,s),o=(f-u)/(f-u+(_-x)),e.copy(s).addScaledVector(ef,o);const d=1/(p+M+h);return a=M*d,o=h*d,e.copy(n).addScaledVector(ur,a).addScaledVector(fr,o)}equals(t){return t.a.equals(this.a)&&t.b.equals(this.b)&&t.c.equals(this.c)}}const mp={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074},Qi={h:0,s:0,l:0},Za={h:0,s:0,l:0};function jl(i,t,e){return e<0&&(e+=1),e>1&&(e-=1),e<1/6?i+(t-i)*6*e:e<1/2?t:e<2/3?i+(t-i)*6*(2/3-e):i}class ne{constructor(t,e,n){return this.isColor=!0,this.r=1,this.g=1,this.b=1,this.set(t,e,n)}set(t,e,n){if(e===void 0&&n===void 0){const s=t;s&&s.isColor?this.copy(s):typeof s=="number"?this.setHex(s):typeof s=="string"&&this.setStyle(s)}else this.setRGB(t,e,n);return this}setScalar(t){return this.r=t,this.g=t,this.b=t,this}setHex(t,e=yi){return t=Math.floor(t),this.r=(t>>16&255)/255,this.g=(t>>8&255)/255,this.b=(t&255)/255,ye.toWorkingColorSpace(this,e),this}setRGB(t,e,n,s=ye.workingColorSpace){return this.r=t,this.g=e,this.b=n,ye.toWorkingColorSpace(this,s),this}setHSL(t,e,n,s=ye.workingColorSpace){if(t=T_(t,1),e=Pn(e,0,1),n=Pn(n,0,1),e===0)this.r=this.g=this.b=n;else{const r=n<=.5?n*(1+e):n+e-n*e,a=2*n-r;this.r=jl(a,r,t+1/3),this.g=jl(a,r,t),this.b=jl(a,r,t-1/3)}return ye.toWorkingColorSpace(this,s),this}setStyle(t,e=yi){function n(r){r!==void 0&&parseFloat(r)<1&&console.warn("THREE.Color: Alpha component of "+t+" will be ignored.")}let s;if(s=/^(\w+)\(([^\)]*)\)/.exec(t)){let r;const a=s[1],o=s[2];switch(a){case"rgb":case"rgba":if(r=/^\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*(?:,\s*(\d*\.?\d+)\s*)?$/.exec(o))return n(r[4]),this.setRGB(Math.min(255,parseInt(r[1],10))/255,Math.min(255,parseInt(r[2],10))/255,Math.min(255,parseInt(r[3],10))/255,e);if(r=/^\s*(\d+)\%\s*,\s*(\d+)\%\s*,\s*(\d+)\%\s*(?:,\s*(\d*\.?\d+)\s*)?$/.exec(o))return n(r[4]),this.setRGB(Math.min(100,parseInt(r[1],10))/100,Math.min(100,parseInt(r[2],10))/100,Math.min(100,parseInt(r[3],10))/100,e);break;case"hsl":case"hsla":if(r=/^\s*(\d*\.?\d+)\s*,\s*(\d*\.?\d+)\%\s*,\s*(\d*\.?\d+)\%\s*(?:,\s*(\d*\.?\d+)\s*)?$/.exec(o))return n(r[4]),this.setHSL(parseFloat(r[1])/360,parseFloat(r[2])/100,parseFloat(r[3])/100,e);break;default:console.warn("THREE.Color: Unknown color model "+t)}}else if(s=/^\#([A-Fa-f\d]+)$/.exec(t)){const r=s[1],a=r.length;if(a===3)return this.setRGB(parseInt(r.charAt(0),16)/15,parseInt(r.charAt(1),16)/15,parseInt(r.charAt(2),16)/15,e);if(a===6)return this.setHex(parseInt(r,16),e);console.warn("THREE.Color: Invalid hex color "+t)}else if(t&&t.length>0)return this.setColorName(t,e);return this}setColorName(t,e=yi){const n=mp[t.toLowerCase()];return n!==void 0?this.setHex(n,e):console.warn("THREE.Color: Unknown color "+t),this}clone(){return new this.constructor(this.r,this.g,this.b)}copy(t){return this.r=t.r,this.g=t.g,this.b=t.b,this}copySRGBToLinear(t){return this.r=Dr(t.r),this.g=Dr(t.g),this.b=Dr(t.b),this}copyLinearToSRGB(t){return this.r=Dl(t.r),this.g=Dl(t.g),this.b=Dl(t.b),this}convertSRGBToLinear(){return this.copySRGBToLinear(this),this}convertLinearToSRGB(){return this.copyLinearToSRGB(this),this}getHex(t=yi){return ye.fromWorkingColorSpace(yn.copy(this),t),Math.round(Pn(yn.r*255,0,255))*65536+Math.round(Pn(yn.g*255,0,255))*256+Math.round(Pn(yn.b*255,0,255))}getHexString(t=yi){return("000000"+this.getHex(t).toString(16)).slice(-6)}getHSL(t,e=ye.workingColorSpace){ye.fromWorkingColorSpace(yn.copy(this),e);const n=yn.r,s=yn.g,r=yn.b,a=Math.max(n,s,r),o=Math.min(n,s,r);let l,c;const u=(o+a)/2;if(o===a)l=0,c=0;else{const f=a-o;switch(c=u<=.5?f/(a+o):f/(2-a-o),a){case n:l=(s-r)/f+(s<r?6:0);break;case s:l=(r-n)/f+2;break;case r:l=(n-s)/f+4;break}l/=6}return t.h=l,t.s=c,t.l=u,t}getRGB(t,e=ye.workingColorSpace){return ye.fromWorkingColorSpace(yn.copy(this),e),t.r=yn.r,t.g=yn.g,t.b=yn.b,t}getStyle(t=yi){ye.fromWorkingColorSpace(yn.copy(this),t);const e=yn.r,n=yn.g,s=yn.b;return t!==yi?`color(${t} ${e.toFixed(3)} ${n.toFixed(3)} ${s.toFixed(3)})`:`rgb(${Math.round(e*255)},${Math.round(n*255)},${Math.round(s*255)})`}offsetHSL(t,e,n){return this.getHSL(Qi),this.setHSL(Qi.h+t,Qi.s+e,Qi.l+n)}add(t){return this.r+=t.r,this.g+=t.g,this.b+=t.b,this}addColors(t,e){return this.r=t.r+e.r,this.g=t.g+e.g,this.b=t.b+e.b,this}addScalar(t){return this.r+=t,this.g+=t,this.b+=t,this}sub(t){return this.r=Math.max(0,this.r-t.r),this.g=Math.max(0,this.g-t.g),this.b=Math.max(0,this.b-t.b),this}multiply(t){return this.r*=t.r,this.g*=t.g,this.b*=t.b,this}multiplyScalar(t){return this.r*=t,this.g*=t,this.b*=t,this}lerp(t,e){return this.r+=(t.r-this.r)*e,this.g+=(t.g-this.g)*e,this.b+=(t.b-this.b)*e,this}lerpColors(t,e,n){return this.r=t.r+(e.r-t.r)*n,this.g=t.g+(e.g-t.g)*n,this.b=t.b+(e.b-t.b)*n,this}lerpHSL(t,e){this.getHSL(Qi),t.getHSL(Za);const n=Pl(Qi.h,Za.h,e),s=Pl(Qi.s,Za.s,e),r=Pl(Qi.l,Za.l,e);return this.setHSL(n,s,r),this}setFromVector3(t){return this.r=t.x,this.g=t.y,this.b=t.z,this}applyMatrix3(t){const e=this.r,n=this.g,s=this.b,r=t.elements;return this.r=r[0]*e+r[3]*n+r[6]*s,this.g=r[1]*e+r[4]*n+r[7]*s,this.b=r[2]*e+r[5]*n+r[8]*s,this}equals(t){return t.r===this.r&&t.g===this.g&&t.b===this.b}fromArray(t,e=0){return this.r=t[e],this.g=t[e+1],this.b=t[e+2],this}toArray(t=[],e=0){return t[e]=this.r,t[e+1]=this.g,t[e+2]=this.b,t}fromBufferAttribute(t,e){return this.r=t.getX(e),this.g=t.getY(e),this.b=t.getZ(e),this}toJSON(){return this.getHex()}*[Symbol.iterator](){yield this.r,yield this.g,yield this.b}}const yn=new ne;ne.NAMES=mp;let X_=0;class Gs extends Hs{constructor(){super(),this.isMaterial=!0,Object.defineProperty(this,"id",{value:X_++}),this.uuid=cs(),this.name="",this.type="Material",this.blending=Pr,this.side=us,this.vertexColors=!1,this.opacity=1,this.transparent=!1,this.alphaHash=!1,this.blendSrc=Tc,this.blendDst=Ac,this.blendEquation=Rs,this.blendSrcAlpha=null,this.blendDstAlpha=null,this.blendEquationAlpha=null,this.blendColor=new ne(0,0,0),this.blendAlpha=0,this.depthFunc=Ur,this.depthTest=!0,this.depthWrite=!0,this.stencilWriteMask=255,this.stencilFunc=Gu,this.stencilRef=0,this.stencilFuncMask=255,this.stencilFail=ir,this.stencilZFail=ir,this.stencilZPass=ir,this.stencilWrite=!1,this.clippingPlanes=null,this.clipIntersection=!1,this.clipShadows=!1,this.shadowSide=null,this.colorWrite=!0,this.precision=null,this.polygonOffset=!1,this.polygonOffsetFactor=0,this.polygonOffsetUnits=0,this.dithering=!1,this.alphaToCoverage=!1,this.premultipliedAlpha=!1,this.forceSinglePass=!1,this.visible=!0,this.toneMapped=!0,this.userData={},this.version=0,this._alphaTest=0}get alphaTest(){return this._alphaTest}set alphaTest(t){this._alphaTest>0!=t>0&&this.version++,this._alphaTest=t}onBeforeRender(){}onBeforeCompile(){}customProgramCacheKey(){return this.onBeforeCompile.toString()}setValues(t){if(t!==void 0)for(const e in t){const n=t[e];if(n===void 0){console.warn(`THREE.Material: parameter '${e}' has value of undefined.`);continue}const s=this[e];if(s===void 0){console.warn(`THREE.Material: '${e}' is not a property of THREE.${this.type}.`);continue}s&&s.isColor?s.set(n):s&&s.isVector3&&n&&n.isVector3?s.copy(n):this[e]=n}}toJSON(t){const e=t===void 0||typeof t=="string";e&&(t={textures:{},images:{}});const n={metadata:{version:4.6,type:"Material",generator:"Material.toJSON"}};n.uuid=this.uuid,n.type=this.type,this.name!==""&&(n.name=this.name),this.color&&this.color.isColor&&(n.color=this.color.getHex()),this.roughness!==void 0&&(n.roughness=this.roughness),this.metalness!==void 0&&(n.metalness=this.metalness),this.sheen!==void 0&&(n.sheen=this.sheen),this.sheenColor&&this.sheenColor.isColor&&(n.sheenColor=this.sheenColor.getHex()),this.sheenRoughness!==void 0&&(n.sheenRoughness=this.sheenRoughness),this.emissive&&this.emissive.isColor&&(n.emissive=this.emissive.getHex()),this.emissiveIntensity!==void 0&&this.emissiveIntensity!==1&&(n.emissiveIntensity=this.emissiveIntensity),this.specular&&this.specular.isColor&&(n.specular=this.specular.getHex()),this.specularIntensity!==void 0&&(n.specularIntensity=this.specularIntensity),this.specularColor&&this.specularColor.isColor&&(n.specularColor=this.specularColor.getHex()),this.shininess!==void 0&&(n.shininess=this.shininess),this.clearcoat!==void 0&&(n.clearcoat=this.clearcoat),this.clearcoatRoughness!==void 0&&(n.clearcoatRoughness=this.clearcoatRoughness),this.clearcoatMap&&this.clearcoatMap.isTexture&&(n.clearcoatMap=this.clearcoatMap.toJSON(t).uuid),this.clearcoatRoughnessMap&&this.clearcoatRoughnessMap.isTexture&&(n.clearcoatRoughnessMap=this.clearcoatRoughnessMap.toJSON(t).uuid),this.clearcoatNormalMap&&this.clearcoatNormalMap.isTexture&&(n.clearcoatNormalMap=this.clearcoatNormalMap.toJSON(t).uuid,n.clearcoatNormalScale=this.clearcoatNormalScale.toArray()),this.dispersion!==void 0&&(n.dispersion=this.dispersion),this.iridescence!==void 0&&(n.iridescence=this.iridescence),this.iridescenceIOR!==void 0&&(n.iridescenceIOR=this.iridescenceIOR),this.iridescenceThicknessRange!==void 0&&(n.iridescenceThicknessRange=this.iridescenceThicknessRange),this.iridescenceMap&&this.iridescenceMap.isTexture&&(n.iridescenceMap=this.iridescenceMap.toJSON(t).uuid),this.iridescenceThicknessMap&&this.iridescenceThicknessMap.isTexture&&(n.iridescenceThicknessMap=this.iridescenceThicknessMap.toJSON(t).uuid),this.anisotropy!==void 0&&(n.anisotropy=this.anisotropy),this.anisotropyRotation!==void 0&&(n.anisotropyRotation=this.anisotropyRotation),this.anisotropyMap&&this.anisotropyMap.isTexture&&(n.anisotropyMap=this.anisotropyMap.toJSON(t).uuid),this.map&&this.map.isTexture&&(n.map=this.map.toJSON(t).uuid),this.matcap&&this.matcap.isTexture&&(n.matcap=this.matcap.toJSON(t).uuid),this.alphaMap&&this.alphaMap.isTexture&&(n.alphaMap=this.alphaMap.toJSON(t).uuid),this.lightMap&&this.lightMap.isTexture&&(n.lightMap=this.lightMap.toJSON(t).uuid,n.lightMapIntensity=this.lightMapIntensity),this.aoMap&&this.aoMap.isTexture&&(n.aoMap=this.aoMap.toJSON(t).uuid,n.aoMapIntensity=this.aoMapIntensity),this.bumpMap&&this.bumpMap.isTexture&&(n.bumpMap=this.bumpMap.toJSON(t).uuid,n.bumpScale=this.bumpScale),this.normalMap&&this.normalMap.isTexture&&(n.normalMap=this.normalMap.toJSON(t).uuid,n.normalMapType=this.normalMapType,n.normalScale=this.normalScale.toArray()),this.displacementMap&&this.displacementMap.isTexture&&(n.displacementMap=this.displacementMap.toJSON(t).uuid,n.displacementScale=this.displacementScale,n.displacementBias=this.displacementBias),this.roughnessMap&&this.roughnessMap.isTexture&&(n.roughnessMap=this.roughnessMap.toJSON(t).uuid),this.metalnessMap&&this.metalnessMap.isTexture&&(n.metalnessMap=this.metalnessMap.toJSON(t).uuid),this.emissiveMap&&this.emissiveMap.isTexture&&(n.emissiveMap=this.emissiveMap.toJSON(t).uuid),this.specularMap&&this.specularMap.isTexture&&(n.specularMap=this.specularMap.toJSON(t).uuid),this.specularIntensityMap&&this.specularIntensityMap.isTexture&&(n.specularIntensityMap=this.specularIntensityMap.toJSON(t).uuid),this.specularColorMap&&this.specularColorMap.isTexture&&(n.specularColorMap=this.specularColorMap.toJSON(t).uuid),this.envMap&&this.envMap.isTexture&&(n.envMap=this.envMap.toJSON(t).uuid,this.combine!==void 0&&(n.combine=this.combine)),this.envMapRotation!==void 0&&(n.envMapRotation=this.envMapRotation.toArray()),this.envMapIntensity!==void 0&&(n.envMapIntensity=this.envMapIntensity),this.reflectivity!==void 0&&(n.reflectivity=this.reflectivity),this.refractionRatio!==void 0&&(n.refractionRatio=this.refractionRatio),this.gradientMap&&this.gradientMap.isTexture&&(n.gradientMap=this.gradientMap.toJSON(t).uuid),this.transmission!==void 0&&(n.transmission=this.transmission),this.transmissionMap&&this.transmissionMap.isTexture&&(n.transmissionMap=this.transmissionMap.toJSON(t).uuid),this.thickness!==void 0&&(n.thickness=this.thickness),this.thicknessMap&&this.thicknessMap.isTexture&&(n.thicknessMap=this.thicknessMap.toJSON(t).uuid),this.attenuationDistance!==void 0&&this.attenuationDistance!==1/0&&(n.attenuationDistance=this.attenuationDistance),this.attenuationColor!==void 0&&(n.attenuationColor=this.attenuationColor.getHex()),this.size!==void 0&&(n.size=this.size),this.shadowSide!==null&&(n.shadowSide=this.shadowSide),this.sizeAttenuation!==void 0&&(n.sizeAttenuation=this.sizeAttenuation),this.blending!==Pr&&(n.blending=this.blending),this.side!==us&&(n.side=this.side),this.vertexColors===!0&&(n.vertexColors=!0),this.opacity<1&&(n.opacity=this.opacity),this.transparent===!0&&(n.transparent=!0),this.blendSrc!==Tc&&(n.blendSrc=this.blendSrc),this.blendDst!==Ac&&(n.blendDst=this.blendDst),this.blendEquation!==Rs&&(n.blendEquation=this.blendEquation),this.blendSrcAlpha!==null&&(n.blendSrcAlpha=this.blendSrcAlpha),this.blendDstAlpha!==null&&(n.blendDstAlpha=this.blendDstAlpha),this.blendEquationAlpha!==null&&(n.blendEquationAlpha=this.blendEquationAlpha),this.blendColor&&this.blendColor.isColor&&(n.blendColor=this.blendColor.getHex()),this.blendAlpha!==0&&(n.blendAlpha=this.blendAlpha),this.depthFunc!==Ur&&(n.depthFunc=this.depthFunc),this.depthTest===!1&&(n.depthTest=this.depthTest),this.depthWrite===!1&&(n.depthWrite=this.depthWrite),this.colorWrite===!1&&(n.colorWrite=this.colorWrite),this.stencilWriteMask!==255&&(n.stencilWriteMask=this.stencilWriteMask),this.stencilFunc!==Gu&&(n.stencilFunc=this.stencilFunc),this.stencilRef!==0&&(n.stencilRef=this.stencilRef),this.stencilFuncMask!==255&&(n.stencilFuncMask=this.stencilFuncMask),this.stencilFail!==ir&&(n.stencilFail=this.stencilFail),this.stencilZFail!==ir&&(n.stencilZFail=this.stencilZFail),this.stencilZPass!==ir&&(n.stencilZPass=this.stencilZPass),this.stencilWrite===!0&&(n.stencilWrite=this.stencilWrite),this.rotation!==void 0&&this.rotation!==0&&(n.rotation=this.rotation),this.polygonOffset===!0&&(n.polygonOffset=!0),this.polygonOffsetFactor!==0&&(n.polygonOffsetFactor=this.polygonOffsetFactor),this.polygonOffsetUnits!==0&&(n.polygonOffsetUnits=this.polygonOffsetUnits),this.linewidth!==void 0&&this.linewidth!==1&&(n.linewidth=this.linewidth),this.dashSize!==void 0&&(n.dashSize=this.dashSize),this.gapSize!==void 0&&(n.gapSize=this.gapSize),this.scale!==void 0&&(n.scale=this.scale),this.dithering===!0&&(n.dithering=!0),this.alphaTest>0&&(n.alphaTest=this.alphaTest),this.alphaHash===!0&&(n.alphaHash=!0),this.alphaToCoverage===!0&&(n.alphaToCoverage=!0),this.premultipliedAlpha===!0&&(n.premultipliedAlpha=!0),this.forceSinglePass===!0&&(n.forceSinglePass=!0),this.wireframe===!0&&(n.wireframe=!0),this.wireframeLinewidth>1&&(n.wireframeLinewidth=this.wireframeLinewidth),this.wireframeLinecap!=="round"&&(n.wireframeLinecap=this.wireframeLinecap),this.wireframeLinejoin!=="round"&&(n.wireframeLinejoin=this.wireframeLinejoin),this.flatShading===!0&&(n.flatShading=!0),this.visible===!1&&(n.visible=!1),this.toneMapped===!1&&(n.toneMapped=!1),this.fog===!1&&(n.fog=!1),Object.keys(this.userData).length>0&&(n.userData=this.userData);function s(r){const a=[];for(const o in r){const l=r[o];delete l.metadata,a.push(l)}return a}if(e){const r=s(t.textures),a=s(t.images);r.length>0&&(n.textures=r),a.length>0&&(n.images=a)}return n}clone(){return new this.constructor().copy(this)}copy(t){this.name=t.name,this.blending=t.blending,this.side=t.side,this.vertexColors=t.vertexColors,this.opacity=t.opacity,this.transparent=t.transparent,this.blendSrc=t.blendSrc,this.blendDst=t.blendDst,this.blendEquation=t.blendEquation,this.blendSrcAlpha=t.blendSrcAlpha,this.blendDstAlpha=t.blendDstAlpha,this.blendEquationAlpha=t.blendEquationAlpha,this.blendColor.copy(t.blendColor),this.blendAlpha=t.blendAlpha,this.depthFunc=t.depthFunc,this.depthTest=t.depthTest,this.depthWrite=t.depthWrite,this.stencilWriteMask=t.stencilWriteMask,this.stencilFunc=t.stencilFunc,this.stencilRef=t.stencilRef,this.stencilFuncMask=t.stencilFuncMask,this.stencilFail=t.stencilFail,this.stencilZFail=t.stencilZFail,this.stencilZPass=t.stencilZPass,this.stencilWrite=t.stencilWrite;const e=t.clippingPlanes;let n=null;if(e!==null){const s=e.length;n=new Array(s);for(let r=0;r!==s;++r)n[r]=e[r].clone()}return this.clippingPlanes=n,this.clipIntersection=t.clipIntersection,this.clipShadows=t.clipShadows,this.shadowSide=t.shadowSide,this.colorWrite=t.colorWrite,this.precision=t.precision,this.polygonOffset=t.polygonOffset,this.polygonOffsetFactor=t.polygonOffsetFactor,this.polygonOffsetUnits=t.polygonOffsetUnits,this.dithering=t.dithering,this.alphaTest=t.alphaTest,this.alphaHash=t.alphaHash,this.alphaToCoverage=t.alphaToCoverage,this.premultipliedAlpha=t.premultipliedAlpha,this.forceSinglePass=t.forceSinglePass,this.visible=t.visible,this.toneMapped=t.toneMapped,this.userData=JSON.parse(JSON.stringify(t.userData)),this}dispose(){this.dispatchEvent({type:"dispose"})}set needsUpdate(t){t===!0&&this.version++}onBuild(){console.warn("Material: onBuild() has been removed.")}}class Xr extends Gs{constructor(t){super(),this.isMeshBasicMaterial=!0,this.type="MeshBasicMaterial",this.color=new ne(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new Ai,this.combine=Ph,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.combine=t.combine,this.reflectivity=t.reflectivity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.fog=t.fog,this}}const Je=new j,Ja=new Qt;class Wn{constructor(t,e,n=!1){if(Array.isArray(t))throw new TypeError("THREE.BufferAttribute: array should be a Typed Array.");this.isBufferAttribute=!0,this.name="",this.array=t,this.itemSize=e,this.count=t!==void 0?t.length/e:0,this.normalized=n,this.usage=uh,this.updateRanges=[],this.gpuType=Bi,this.version=0}onUploadCallback(){}set needsUpdate(t){t===!0&&this.version++}setUsage(t){return this.usage=t,this}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}copy(t){return this.name=t.name,this.array=new t.array.constructor(t.array),this.itemSize=t.itemSize,this.count=t.count,this.normalized=t.normalized,this.usage=t.usage,this.gpuType=t.gpuType,this}copyAt(t,e,n){t*=this.itemSize,n*=e.itemSize;for(let s=0,r=this.itemSize;s<r;s++)this.array[t+s]=e.array[n+s];return this}copyArray(t){return this.array.set(t),this}applyMatrix3(t){if(this.itemSize===2)for(let e=0,n=this.count;e<n;e++)Ja.fromBufferAttribute(this,e),Ja.applyMatrix3(t),this.setXY(e,Ja.x,Ja.y);else if(this.itemSize===3)for(let e=0,n=this.count;e<n;e++)Je.fromBufferAttribute(this,e),Je.applyMatrix3(t),this.setXYZ(e,Je.x,Je.y,Je.z);return this}applyMatrix4(t){for(let e=0,n=this.count;e<n;e++)Je.fromBufferAttribute(this,e),Je.applyMatrix4(t),this.setXYZ(e,Je.x,Je.y,Je.z);return this}applyNormalMatrix(t){for(let e=0,n=this.count;e<n;e++)Je.fromBufferAttribute(this,e),Je.applyNormalMatrix(t),this.setXYZ(e,Je.x,Je.y,Je.z);return this}transformDirection(t){for(let e=0,n=this.count;e<n;e++)Je.fromBufferAttribute(this,e),Je.transformDirection(t),this.setXYZ(e,Je.x,Je.y,Je.z);return this}set(t,e=0){return this.array.set(t,e),this}getComponent(t,e){let n=this.array[t*this.itemSize+e];return this.normalized&&(n=wi(n,this.array)),n}setComponent(t,e,n){return this.normalized&&(n=we(n,this.array)),this.array[t*this.itemSize+e]=n,this}getX(t){let e=this.array[t*this.itemSize];return this.normalized&&(e=wi(e,this.array)),e}setX(t,e){return this.normalized&&(e=we(e,this.array)),this.array[t*this.itemSize]=e,this}getY(t){let e=this.array[t*this.itemSize+1];return this.normalized&&(e=wi(e,this.array)),e}setY(t,e){return this.normalized&&(e=we(e,this.array)),this.array[t*this.itemSize+1]=e,this}getZ(t){let e=this.array[t*this.itemSize+2];return this.normalized&&(e=wi(e,this.array)),e}setZ(t,e){return this.normalized&&(e=we(e,this.array)),this.array[t*this.itemSize+2]=e,this}getW(t){let e=this.array[t*this.itemSize+3];return this.normalized&&(e=wi(e,this.array)),e}setW(t,e){return this.normalized&&(e=we(e,this.array)),this.array[t*this.itemSize+3]=e,this}setXY(t,e,n){return t*=this.itemSize,this.normalized&&(e=we(e,this.array),n=we(n,this.array)),this.array[t+0]=e,this.array[t+1]=n,this}setXYZ(t,e,n,s){return t*=this.itemSize,this.normalized&&(e=we(e,this.array),n=we(n,this.array),s=we(s,this.array)),this.array[t+0]=e,this.array[t+1]=n,this.array[t+2]=s,this}setXYZW(t,e,n,s,r){return t*=this.itemSize,this.normalized&&(e=we(e,this.array),n=we(n,this.array),s=we(s,this.array),r=we(r,this.array)),this.array[t+0]=e,this.array[t+1]=n,this.array[t+2]=s,this.array[t+3]=r,this}onUpload(t){return this.onUploadCallback=t,this}clone(){return new this.constructor(this.array,this.itemSize).copy(this)}toJSON(){const t={itemSize:this.itemSize,type:this.array.constructor.name,array:Array.from(this.array),normalized:this.normalized};return this.name!==""&&(t.name=this.name),this.usage!==uh&&(t.usage=this.usage),t}}class gp extends Wn{constructor(t,e,n){super(new Uint16Array(t),e,n)}}class _p extends Wn{constructor(t,e,n){super(new Uint32Array(t),e,n)}}class Be extends Wn{constructor(t,e,n){super(new Float32Array(t),e,n)}}let q_=0;const $n=new Ge,Kl=new an,dr=new j,zn=new La,ha=new La,dn=new j;class gn extends Hs{constructor(){super(),this.isBufferGeometry=!0,Object.defineProperty(this,"id",{value:q_++}),this.uuid=cs(),this.name="",this.type="BufferGeometry",this.index=null,this.attributes={},this.morphAttributes={},this.morphTargetsRelative=!1,this.groups=[],this.boundingBox=null,this.boundingSphere=null,this.drawRange={start:0,count:1/0},this.userData={}}getIndex(){return this.index}setIndex(t){return Array.isArray(t)?this.index=new(up(t)?_p:gp)(t,1):this.index=t,this}getAttribute(t){return this.attributes[t]}setAttribute(t,e){return this.attributes[t]=e,this}deleteAttribute(t){return delete this.attributes[t],this}hasAttribute(t){return this.attributes[t]!==void 0}addGroup(t,e,n=0){this.groups.push({start:t,count:e,materialIndex:n})}clearGroups(){this.groups=[]}setDrawRange(t,e){this.drawRange.start=t,this.drawRange.count=e}applyMatrix4(t){const e=this.attributes.position;e!==void 0&&(e.applyMatrix4(t),e.needsUpdate=!0);const n=this.attributes.normal;if(n!==void 0){const r=new oe().getNormalMatrix(t);n.applyNormalMatrix(r),n.needsUpdate=!0}const s=this.attributes.tangent;return s!==void 0&&(s.transformDirection(t),s.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this}applyQuaternion(t){return $n.makeRotationFromQuaternion(t),this.applyMatrix4($n),this}rotateX(t){return $n.makeRotationX(t),this.applyMatrix4($n),this}rotateY(t){return $n.makeRotationY(t),this.applyMatrix4($n),this}rotateZ(t){return $n.makeRotationZ(t),this.applyMatrix4($n),this}translate(t,e,n){return $n.makeTranslation(t,e,n),this.applyMatrix4($n),this}scale(t,e,n){return $n.makeScale(t,e,n),this.applyMatrix4($n),this}lookAt(t){return Kl.lookAt(t),Kl.updateMatrix(),this.applyMatrix4(Kl.matrix),this}center(){return this.computeBoundingBox(),this.boundingBox.getCenter(dr).negate(),this.translate(dr.x,dr.y,dr.z),this}setFromPoints(t){const e=[];for(let n=0,s=t.length;n<s;n++){const r=t[n];e.push(r.x,r.y,r.z||0)}return this.setAttribute("position",new Be(e,3)),this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new La);const t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){console.error("THREE.BufferGeometry.computeBoundingBox(): GLBufferAttribute requires a manual bounding box.",this),this.boundingBox.set(new j(-1/0,-1/0,-1/0),new j(1/0,1/0,1/0));return}if(t!==void 0){if(this.boundingBox.setFromBufferAttribute(t),e)for(let n=0,s=e.length;n<s;n++){const r=e[n];zn.setFromBufferAttribute(r),this.morphTargetsRelative?(dn.addVectors(this.boundingBox.min,zn.min),this.boundingBox.expandByPoint(dn),dn.addVectors(this.boundingBox.max,zn.max),this.boundingBox.expandByPoint(dn)):(this.boundingBox.expandByPoint(zn.min),this.boundingBox.expandByPoint(zn.max))}}else this.boundingBox.makeEmpty();(isNaN(this.boundingBox.min.x)||isNaN(this.boundingBox.min.y)||isNaN(this.boundingBox.min.z))&&console.error('THREE.BufferGeometry.computeBoundingBox(): Computed min/max have NaN values. The "position" attribute is likely to have NaN values.',this)}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new el);const t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){console.error("THREE.BufferGeometry.computeBoundingSphere(): GLBufferAttribute requires a manual bounding sphere.",this),this.boundingSphere.set(new j,1/0);return}if(t){const n=this.boundingSphere.center;if(zn.setFromBufferAttribute(t),e)for(let r=0,a=e.length;r<a;r++){const o=e[r];ha.setFromBufferAttribute(o),this.morphTargetsRelative?(dn.addVectors(zn.min,ha.min),zn.expandByPoint(dn),dn.addVectors(zn.max,ha.max),zn.expandByPoint(dn)):(zn.expandByPoint(ha.min),zn.expandByPoint(ha.max))}zn.getCenter(n);let s=0;for(let r=0,a=t.count;r<a;r++)dn.fromBufferAttribute(t,r),s=Math.max(s,n.distanceToSquared(dn));if(e)for(let r=0,a=e.length;r<a;r++){const o=e[r],l=this.morphTargetsRelative;for(let c=0,u=o.count;c<u;c++)dn.fromBufferAttribute(o,c),l&&(dr.fromBufferAttribute(t,c),dn.add(dr)),s=Math.max(s,n.distanceToSquared(dn))}this.boundingSphere.radius=Math.sqrt(s),isNaN(this.boundingSphere.radius)&&console.error('THREE.BufferGeometry.computeBoundingSphere(): Computed radius is NaN. The "position" attribute is likely to have NaN values.',this)}}computeTangents(){const t=this.index,e=this.attributes;if(t===null||e.position===void 0||e.normal===void 0||e.uv===void 0){console.error("THREE.BufferGeometry: .computeTangents() failed. Missing required attributes (index, position, normal or uv)");return}const n=e.position,s=e.normal,r=e.uv;this.hasAttribute("tangent")===!1&&this.setAttribute("tangent",new Wn(new Float32Array(4*n.count),4));const a=this.getAttribute("tangent"),o=[],l=[];for(let P=0;P<n.count;P++)o[P]=new j,l[P]=new j;const c=new j,u=new j,f=new j,h=new Qt,_=new Qt,x=new Qt,M=new j,p=new j;function d(P,O,g){c.fromBufferAttribute(n,P),u.fromBufferAttribute(n,O),f.fromBufferAttribute(n,g),h.fromBufferAttribute(r,P),_.fromBufferAttribute(r,O),x.fromBufferAttribute(r,g),u.sub(c),f.sub(c),_.sub(h),x.sub(h);const m=1/(_.x*x.y-x.x*_.y);isFinite(m)&&(M.copy(u).multiplyScalar(x.y).addScaledVector(f,-_.y).multiplyScalar(m),p.copy(f).multiplyScalar(_.x).addScaledVector(u,-x.x).multiplyScalar(m),o[P].add(M),o[O].add(M),o[g].add(M),l[P].add(p),l[O].add(p),l[g].add(p))}let C=this.groups;C.length===0&&(C=[{start:0,count:t.count}]);for(let P=0,O=C.length;P<O;++P){const g=C[P],m=g.start,E=g.count;for(let N=m,F=m+E;N<F;N+=3)d(t.getX(N+0),t.getX(N+1),t.getX(N+2))}const b=new j,R=new j,D=new j,A=new j;function y(P){D.fromBufferAttribute(s,P),A.copy(D);const O=o[P];b.copy(O),b.sub(D.multiplyScalar(D.dot(O))).normalize(),R.crossVectors(A,O);const m=R.dot(l[P])<0?-1:1;a.setXYZW(P,b.x,b.y,b.z,m)}for(let P=0,O=C.length;P<O;++P){const g=C[P],m=g.start,E=g.count;for(let N=m,F=m+E;N<F;N+=3)y(t.getX(N+0)),y(t.getX(N+1)),y(t.getX(N+2))}}computeVertexNormals(){const t=this.index,e=this.getAttribute("position");if(e!==void 0){let n=this.getAttribute("normal");if(n===void 0)n=new Wn(new Float32Array(e.count*3),3),this.setAttribute("normal",n);else for(let h=0,_=n.count;h<_;h++)n.setXYZ(h,0,0,0);const s=new j,r=new j,a=new j,o=new j,l=new j,c=new j,u=new j,f=new j;if(t)for(let h=0,_=t.count;h<_;h+=3){const x=t.getX(h+0),M=t.getX(h+1),p=t.getX(h+2);s.fromBufferAttribute(e,x),r.fromBufferAttribute(e,M),a.fromBufferAttribute(e,p),u.subVectors(a,r),f.subVectors(s,r),u.cross(f),o.fromBufferAttribute(n,x),l.fromBufferAttribute(n,M),c.fromBufferAttribute(n,p),o.add(u),l.add(u),c.add(u),n.setXYZ(x,o.x,o.y,o.z),n.setXYZ(M,l.x,l.y,l.z),n.setXYZ(p,c.x,c.y,c.z)}else for(let h=0,_=e.count;h<_;h+=3)s.fromBufferAttribute(e,h+0),r.fromBufferAttribute(e,h+1),a.fromBufferAttribute(e,h+2),u.subVectors(a,r),f.subVectors(s,r),u.cross(f),n.setXYZ(h+0,u.x,u.y,u.z),n.setXYZ(h+1,u.x,u.y,u.z),n.setXYZ(h+2,u.x,u.y,u.z);this.normalizeNormals(),n.needsUpdate=!0}}normalizeNormals(){const t=this.attributes.normal;for(let e=0,n=t.count;e<n;e++)dn.fromBufferAttribute(t,e),dn.normalize(),t.setXYZ(e,dn.x,dn.y,dn.z)}toNonIndexed(){function t(o,l){const c=o.array,u=o.itemSize,f=o.normalized,h=new c.constructor(l.length*u);let _=0,x=0;for(let M=0,p=l.length;M<p;M++){o.isInterleavedBufferAttribute?_=l[M]*o.data.stride+o.offset:_=l[M]*u;for(let d=0;d<u;d++)h[x++]=c[_++]}return new Wn(h,u,f)}if(this.index===null)return console.warn("THREE.BufferGeometry.toNonIndexed(): BufferGeometry is already non-indexed."),this;const e=new gn,n=this.index.array,s=this.attributes;for(const o in s){const l=s[o],c=t(l,n);e.setAttribute(o,c)}const r=this.morphAttributes;for(const o in r){const l=[],c=r[o];for(let u=0,f=c.length;u<f;u++){const h=c[u],_=t(h,n);l.push(_)}e.morphAttributes[o]=l}e.morphTargetsRelative=this.morphTargetsRelative;const a=this.groups;for(let o=0,l=a.length;o<l;o++){const c=a[o];e.addGroup(c.start,c.count,c.materialIndex)}return e}toJSON(){const t={metadata:{version:4.6,type:"BufferGeometry",generator:"BufferGeometry.toJSON"}};if(t.uuid=this.uuid,t.type=this.type,this.name!==""&&(t.name=this.name),Object.keys(this.userData).length>0&&(t.userData=this.userData),this.parameters!==void 0){const l=this.parameters;for(const c in l)l[c]!==void 0&&(t[c]=l[c]);return t}t.data={attributes:{}};const e=this.index;e!==null&&(t.data.index={type:e.array.constructor.name,array:Array.prototype.slice.call(e.array)});const n=this.attributes;for(const l in n){const c=n[l];t.data.attributes[l]=c.toJSON(t.data)}const s={};let r=!1;for(const l in this.morphAttributes){const c=this.morphAttributes[l],u=[];for(let f=0,h=c.length;f<h;f++){const _=c[f];u.push(_.toJSON(t.data))}u.length>0&&(s[l]=u,r=!0)}r&&(t.data.morphAttributes=s,t.data.morphTargetsRelative=this.morphTargetsRelative);const a=this.groups;a.length>0&&(t.data.groups=JSON.parse(JSON.stringify(a)));const o=this.boundingSphere;return o!==null&&(t.data.boundingSphere={center:o.center.toArray(),radius:o.radius}),t}clone(){return new this.constructor().copy(this)}copy(t){this.index=null,this.attributes={},this.morphAttributes={},this.groups=[],this.boundingBox=null,this.boundingSphere=null;const e={};this.name=t.name;const n=t.index;n!==null&&this.setIndex(n.clone(e));const s=t.attributes;for(const c in s){const u=s[c];this.setAttribute(c,u.clone(e))}const r=t.morphAttributes;for(const c in r){const u=[],f=r[c];for(let h=0,_=f.length;h<_;h++)u.push(f[h].clone(e));this.morphAttributes[c]=u}this.morphTargetsRelative=t.morphTargetsRelative;const a=t.groups;for(let c=0,u=a.length;c<u;c++){const f=a[c];this.addGroup(f.start,f.count,f.materialIndex)}const o=t.boundingBox;o!==null&&(this.boundingBox=o.clone());const l=t.boundingSphere;return l!==null&&(this.boundingSphere=l.clone()),this.drawRange.start=t.drawRange.start,this.drawRange.count=t.drawRange.count,this.userData=t.userData,this}dispose(){this.dispatchEvent({type:"dispose"})}}const nf=new Ge,ys=new Fh,Qa=new el,sf=new j,to=new j,eo=new j,no=new j,$l=new j,io=new j,rf=new j,so=new j;class rn extends an{constructor(t=new gn,e=new Xr){super(),this.isMesh=!0,this.type="Mesh",this.geometry=t,this.material=e,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),t.morphTargetInfluences!==void 0&&(this.morphTargetInfluences=t.morphTargetInfluences.slice()),t.morphTargetDictionary!==void 0&&(this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary)),this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}updateMorphTargets(){const e=this.geometry.morphAttributes,n=Object.keys(e);if(n.length>0){const s=e[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,a=s.length;r<a;r++){const o=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[o]=r}}}}getVertexPosition(t,e){const n=this.geometry,s=n.attributes.position,r=n.morphAttributes.position,a=n.morphTargetsRelative;e.fromBufferAttribute(s,t);const o=this.morphTargetInfluences;if(r&&o){io.set(0,0,0);for(let l=0,c=r.length;l<c;l++){const u=o[l],f=r[l];u!==0&&($l.fromBufferAttribute(f,t),a?io.addScaledVector($l,u):io.addScaledVector($l.sub(e),u))}e.add(io)}return e}raycast(t,e){const n=this.geometry,s=this.material,r=this.matrixWorld;s!==void 0&&(n.boundingSphere===null&&n.computeBoundingSphere(),Qa.copy(n.boundingSphere),Qa.applyMatrix4(r),ys.copy(t.ray).recast(t.near),!(Qa.containsPoint(ys.origin)===!1&&(ys.intersectSphere(Qa,sf)===null||ys.origin.distanceToSquared(sf)>(t.far-t.near)**2))&&(nf.copy(r).invert(),ys.copy(t.ray).applyMatrix4(nf),!(n.boundingBox!==null&&ys.intersectsBox(n.boundingBox)===!1)&&this._computeIntersections(t,e,ys)))}_computeIntersections(t,e,n){let s;const r=this.geometry,a=this.material,o=r.index,l=r.attributes.position,c=r.attributes.uv,u=r.attributes.uv1,f=r.attributes.normal,h=r.groups,_=r.drawRange;if(o!==null)if(Array.isArray(a))for(let x=0,M=h.length;x<M;x++){const p=h[x],d=a[p.materialIndex],C=Math.max(p.start,_.start),b=Math.min(o.count,Math.min(p.start+p.count,_.start+_.count));for(let R=C,D=b;R<D;R+=3){const A=o.getX(R),y=o.getX(R+1),P=o.getX(R+2);s=ro(this,d,t,n,c,u,f,A,y,P),s&&(s.faceIndex=Math.floor(R/3),s.face.materialIndex=p.materialIndex,e.push(s))}}else{const x=Math.max(0,_.start),M=Math.min(o.count,_.start+_.count);for(let p=x,d=M;p<d;p+=3){const C=o.getX(p),b=o.getX(p+1),R=o.getX(p+2);s=ro(this,a,t,n,c,u,f,C,b,R),s&&(s.faceIndex=Math.floor(p/3),e.push(s))}}else if(l!==void 0)if(Array.isArray(a))for(let x=0,M=h.length;x<M;x++){const p=h[x],d=a[p.materialIndex],C=Math.max(p.start,_.start),b=Math.min(l.count,Math.min(p.start+p.count,_.start+_.count));for(let R=C,D=b;R<D;R+=3){const A=R,y=R+1,P=R+2;s=ro(this,d,t,n,c,u,f,A,y,P),s&&(s.faceIndex=Math.floor(R/3),s.face.materialIndex=p.materialIndex,e.push(s))}}else{const x=Math.max(0,_.start),M=Math.min(l.count,_.start+_.count);for(let p=x,d=M;p<d;p+=3){const C=p,b=p+1,R=p+2;s=ro(this,a,t,n,c,u,f,C,b,R),s&&(s.faceIndex=Math.floor(p/3),e.push(s))}}}}function Y_(i,t,e,n,s,r,a,o){let l;if(t.side===On?l=n.intersectTriangle(a,r,s,!0,o):l=n.intersectTriangle(s,r,a,t.side===us,o),l===null)return null;so.copy(o),so.applyMatrix4(i.matrixWorld);const c=e.ray.origin.distanceTo(so);return c<e.near||c>e.far?null:{distance:c,point:so.clone(),object:i}}function ro(i,t,e,n,s,r,a,o,l,c){i.getVertexPosition(o,to),i.getVertexPosition(l,eo),i.getVertexPosition(c,no);const u=Y_(i,t,e,n,to,eo,no,rf);if(u){const f=new j;Vn.getBarycoord(rf,to,eo,no,f),s&&(u.uv=Vn.getInterpolatedAttribute(s,o,l,c,f,new Qt)),r&&(u.uv1=Vn.getInterpolatedAttribute(r,o,l,c,f,new Qt)),a&&(u.normal=Vn.getInterpolatedAttribute(a,o,l,c,f,new j),u.normal.dot(n.direction)>0&&u.normal.multiplyScalar(-1));const h={a:o,b:l,c,normal:new j,materialIndex:0};Vn.getNormal(to,eo,no,h.normal),u.face=h,u.barycoord=f}return u}class qr extends gn{constructor(t=1,e=1,n=1,s=1,r=1,a=1){super(),this.type="BoxGeometry",this.parameters={width:t,height:e,depth:n,widthSegments:s,heightSegments:r,depthSegments:a};const o=this;s=Math.floor(s),r=Math.floor(r),a=Math.floor(a);const l=[],c=[],u=[],f=[];let h=0,_=0;x("z","y","x",-1,-1,n,e,t,a,r,0),x("z","y","x",1,-1,n,e,-t,a,r,1),x("x","z","y",1,1,t,n,e,s,a,2),x("x","z","y",1,-1,t,n,-e,s,a,3),x("x","y","z",1,-1,t,e,n,s,r,4),x("x","y","z",-1,-1,t,e,-n,s,r,5),this.setIndex(l),this.setAttribute("position",new Be(c,3)),this.setAttribute("normal",new Be(u,3)),this.setAttribute("uv",new Be(f,2));function x(M,p,d,C,b,R,D,A,y,P,O){const g=R/y,m=D/P,E=R/2,N=D/2,F=A/2,B=y+1,G=P+1;let $=0,Q=0;const dt=new j;for(let ct=0;ct<G;ct++){const gt=ct*m-N;for(let xt=0;xt<B;xt++){const Vt=xt*g-E;dt[M]=Vt*C,dt[p]=gt*b,dt[d]=F,c.push(dt.x,dt.y,dt.z),dt[M]=0,dt[p]=0,dt[d]=A>0?1:-1,u.push(dt.x,dt.y,dt.z),f.push(xt/y),f.push(1-ct/P),$+=1}}for(let ct=0;ct<P;ct++)for(let gt=0;gt<y;gt++){const xt=h+gt+B*ct,Vt=h+gt+B*(ct+1),rt=h+(gt+1)+B*(ct+1),pt=h+(gt+1)+B*ct;l.push(xt,Vt,pt),l.push(Vt,rt,pt),Q+=6}o.addGroup(_,Q,O),_+=Q,h+=$}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new qr(t.width,t.height,t.depth,t.widthSegments,t.heightSegments,t.depthSegments)}}function Br(i){const t={};for(const e in i){t[e]={};for(const n in i[e]){const s=i[e][n];s&&(s.isColor||s.isMatrix3||s.isMatrix4||s.isVector2||s.isVector3||s.isVector4||s.isTexture||s.isQuaternion)?s.isRenderTargetTexture?(console.warn("UniformsUtils: Textures of render targets cannot be cloned via cloneUniforms() or mergeUniforms()."),t[e][n]=null):t[e][n]=s.clone():Array.isArray(s)?t[e][n]=s.slice():t[e][n]=s}}return t}function Cn(i){const t={};for(let e=0;e<i.length;e++){const n=Br(i[e]);for(const s in n)t[s]=n[s]}return t}function j_(i){const t=[];for(let e=0;e<i.length;e++)t.push(i[e].clone());return t}function vp(i){const t=i.getRenderTarget();return t===null?i.outputColorSpace:t.isXRRenderTarget===!0?t.texture.colorSpace:ye.workingColorSpace}const K_={clone:Br,merge:Cn};var $_=`void main() {
	gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
}`,Z_=`void main() {
	gl_FragColor = vec4( 1.0, 0.0, 0.0, 1.0 );
}`;class fs extends Gs{constructor(t){super(),this.isShaderMaterial=!0,this.type="ShaderMaterial",this.defines={},this.uniforms={},this.uniformsGroups=[],this.vertexShader=$_,this.fragmentShader=Z_,this.linewidth=1,this.wireframe=!1,this.wireframeLinewidth=1,this.fog=!1,this.lights=!1,this.clipping=!1,this.forceSinglePass=!0,this.extensions={clipCullDistance:!1,multiDraw:!1},this.defaultAttributeValues={color:[1,1,1],uv:[0,0],uv1:[0,0]},this.index0AttributeName=void 0,this.uniformsNeedUpdate=!1,this.glslVersion=null,t!==void 0&&this.setValues(t)}copy(t){return super.copy(t),this.fragmentShader=t.fragmentShader,this.vertexShader=t.vertexShader,this.uniforms=Br(t.uniforms),this.uniformsGroups=j_(t.uniformsGroups),this.defines=Object.assign({},t.defines),this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.fog=t.fog,this.lights=t.lights,this.clipping=t.clipping,this.extensions=Object.assign({},t.extensions),this.glslVersion=t.glslVersion,this}toJSON(t){const e=super.toJSON(t);e.glslVersion=this.glslVersion,e.uniforms={};for(const s in this.uniforms){const a=this.uniforms[s].value;a&&a.isTexture?e.uniforms[s]={type:"t",value:a.toJSON(t).uuid}:a&&a.isColor?e.uniforms[s]={type:"c",value:a.getHex()}:a&&a.isVector2?e.uniforms[s]={type:"v2",value:a.toArray()}:a&&a.isVector3?e.uniforms[s]={type:"v3",value:a.toArray()}:a&&a.isVector4?e.uniforms[s]={type:"v4",value:a.toArray()}:a&&a.isMatrix3?e.uniforms[s]={type:"m3",value:a.toArray()}:a&&a.isMatrix4?e.uniforms[s]={type:"m4",value:a.toArray()}:e.uniforms[s]={value:a}}Object.keys(this.defines).length>0&&(e.defines=this.defines),e.vertexShader=this.vertexShader,e.fragmentShader=this.fragmentShader,e.lights=this.lights,e.clipping=this.clipping;const n={};for(const s in this.extensions)this.extensions[s]===!0&&(n[s]=!0);return Object.keys(n).length>0&&(e.extensions=n),e}}class xp extends an{constructor(){super(),this.isCamera=!0,this.type="Camera",this.matrixWorldInverse=new Ge,this.projectionMatrix=new Ge,this.projectionMatrixInverse=new Ge,this.coordinateSystem=zi}copy(t,e){return super.copy(t,e),this.matrixWorldInverse.copy(t.matrixWorldInverse),this.projectionMatrix.copy(t.projectionMatrix),this.projectionMatrixInverse.copy(t.projectionMatrixInverse),this.coordinateSystem=t.coordinateSystem,this}getWorldDirection(t){return super.getWorldDirection(t).negate()}updateMatrixWorld(t){super.updateMatrixWorld(t),this.matrixWorldInverse.copy(this.matrixWorld).invert()}updateWorldMatrix(t,e){super.updateWorldMatrix(t,e),this.matrixWorldInverse.copy(this.matrixWorld).invert()}clone(){return new this.constructor().copy(this)}}const ts=new j,af=new Qt,of=new Qt;class Qn extends xp{constructor(t=50,e=1,n=.1,s=2e3){super(),this.isPerspectiveCamera=!0,this.type="PerspectiveCamera",this.fov=t,this.zoom=1,this.near=n,this.far=s,this.focus=10,this.aspect=e,this.view=null,this.filmGauge=35,this.filmOffset=0,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.fov=t.fov,this.zoom=t.zoom,this.near=t.near,this.far=t.far,this.focus=t.focus,this.aspect=t.aspect,this.view=t.view===null?null:Object.assign({},t.view),this.filmGauge=t.filmGauge,this.filmOffset=t.filmOffset,this}setFocalLength(t){const e=.5*this.getFilmHeight()/t;this.fov=fh*2*Math.atan(e),this.updateProjectionMatrix()}getFocalLength(){const t=Math.tan(Sa*.5*this.fov);return .5*this.getFilmHeight()/t}getEffectiveFOV(){return fh*2*Math.atan(Math.tan(Sa*.5*this.fov)/this.zoom)}getFilmWidth(){return this.filmGauge*Math.min(this.aspect,1)}getFilmHeight(){return this.filmGauge/Math.max(this.aspect,1)}getViewBounds(t,e,n){ts.set(-1,-1,.5).applyMatrix4(this.projectionMatrixInverse),e.set(ts.x,ts.y).multiplyScalar(-t/ts.z),ts.set(1,1,.5).applyMatrix4(this.projectionMatrixInverse),n.set(ts.x,ts.y).multiplyScalar(-t/ts.z)}getViewSize(t,e){return this.getViewBounds(t,af,of),e.subVectors(of,af)}setViewOffset(t,e,n,s,r,a){this.aspect=t/e,this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=n,this.view.offsetY=s,this.view.width=r,this.view.height=a,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){const t=this.near;let e=t*Math.tan(Sa*.5*this.fov)/this.zoom,n=2*e,s=this.aspect*n,r=-.5*s;const a=this.view;if(this.view!==null&&this.view.enabled){const l=a.fullWidth,c=a.fullHeight;r+=a.offsetX*s/l,e-=a.offsetY*n/c,s*=a.width/l,n*=a.height/c}const o=this.filmOffset;o!==0&&(r+=t*o/this.getFilmWidth()),this.projectionMatrix.makePerspective(r,r+s,e,e-n,t,this.far,this.coordinateSystem),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){const e=super.toJSON(t);return e.object.fov=this.fov,e.object.zoom=this.zoom,e.object.near=this.near,e.object.far=this.far,e.object.focus=this.focus,e.object.aspect=this.aspect,this.view!==null&&(e.object.view=Object.assign({},this.view)),e.object.filmGauge=this.filmGauge,e.object.filmOffset=this.filmOffset,e}}const pr=-90,mr=1;class J_ extends an{constructor(t,e,n){super(),this.type="CubeCamera",this.renderTarget=n,this.coordinateSystem=null,this.activeMipmapLevel=0;const s=new Qn(pr,mr,t,e);s.layers=this.layers,this.add(s);const r=new Qn(pr,mr,t,e);r.layers=this.layers,this.add(r);const a=new Qn(pr,mr,t,e);a.layers=this.layers,this.add(a);const o=new Qn(pr,mr,t,e);o.layers=this.layers,this.add(o);const l=new Qn(pr,mr,t,e);l.layers=this.layers,this.add(l);const c=new Qn(pr,mr,t,e);c.layers=this.layers,this.add(c)}updateCoordinateSystem(){const t=this.coordinateSystem,e=this.children.concat(),[n,s,r,a,o,l]=e;for(const c of e)this.remove(c);if(t===zi)n.up.set(0,1,0),n.lookAt(1,0,0),s.up.set(0,1,0),s.lookAt(-1,0,0),r.up.set(0,0,-1),r.lookAt(0,1,0),a.up.set(0,0,1),a.lookAt(0,-1,0),o.up.set(0,1,0),o.lookAt(0,0,1),l.up.set(0,1,0),l.lookAt(0,0,-1);else if(t===Vo)n.up.set(0,-1,0),n.lookAt(-1,0,0),s.up.set(0,-1,0),s.lookAt(1,0,0),r.up.set(0,0,1),r.lookAt(0,1,0),a.up.set(0,0,-1),a.lookAt(0,-1,0),o.up.set(0,-1,0),o.lookAt(0,0,1),l.up.set(0,-1,0),l.lookAt(0,0,-1);else throw new Error("THREE.CubeCamera.updateCoordinateSystem(): Invalid coordinate system: "+t);for(const c of e)this.add(c),c.updateMatrixWorld()}update(t,e){this.parent===null&&this.updateMatrixWorld();const{renderTarget:n,activeMipmapLevel:s}=this;this.coordinateSystem!==t.coordinateSystem&&(this.coordinateSystem=t.coordinateSystem,this.updateCoordinateSystem());const[r,a,o,l,c,u]=this.children,f=t.getRenderTarget(),h=t.getActiveCubeFace(),_=t.getActiveMipmapLevel(),x=t.xr.enabled;t.xr.enabled=!1;const M=n.texture.generateMipmaps;n.texture.generateMipmaps=!1,t.setRenderTarget(n,0,s),t.render(e,r),t.setRenderTarget(n,1,s),t.render(e,a),t.setRenderTarget(n,2,s),t.render(e,o),t.setRenderTarget(n,3,s),t.render(e,l),t.setRenderTarget(n,4,s),t.render(e,c),n.texture.generateMipmaps=M,t.setRenderTarget(n,5,s),t.render(e,u),t.setRenderTarget(f,h,_),t.xr.enabled=x,n.texture.needsPMREMUpdate=!0}}class Mp extends Ln{constructor(t,e,n,s,r,a,o,l,c,u){t=t!==void 0?t:[],e=e!==void 0?e:Nr,super(t,e,n,s,r,a,o,l,c,u),this.isCubeTexture=!0,this.flipY=!1}get images(){return this.image}set images(t){this.image=t}}class Q_ extends Fs{constructor(t=1,e={}){super(t,t,e),this.isWebGLCubeRenderTarget=!0;const n={width:t,height:t,depth:1},s=[n,n,n,n,n,n];this.texture=new Mp(s,e.mapping,e.wrapS,e.wrapT,e.magFilter,e.minFilter,e.format,e.type,e.anisotropy,e.colorSpace),this.texture.isRenderTargetTexture=!0,this.texture.generateMipmaps=e.generateMipmaps!==void 0?e.generateMipmaps:!1,this.texture.minFilter=e.minFilter!==void 0?e.minFilter:ti}fromEquirectangularTexture(t,e){this.texture.type=e.type,this.texture.colorSpace=e.colorSpace,this.texture.generateMipmaps=e.generateMipmaps,this.texture.minFilter=e.minFilter,this.texture.magFilter=e.magFilter;const n={uniforms:{tEquirect:{value:null}},vertexShader:`

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
			`},s=new qr(5,5,5),r=new fs({name:"CubemapFromEquirect",uniforms:Br(n.uniforms),vertexShader:n.vertexShader,fragmentShader:n.fragmentShader,side:On,blending:os});r.uniforms.tEquirect.value=e;const a=new rn(s,r),o=e.minFilter;return e.minFilter===Ds&&(e.minFilter=ti),new J_(1,10,this).update(t,a),e.minFilter=o,a.geometry.dispose(),a.material.dispose(),this}clear(t,e,n,s){const r=t.getRenderTarget();for(let a=0;a<6;a++)t.setRenderTarget(this,a),t.clear(e,n,s);t.setRenderTarget(r)}}const Zl=new j,t0=new j,e0=new oe;class es{constructor(t=new j(1,0,0),e=0){this.isPlane=!0,this.normal=t,this.constant=e}set(t,e){return this.normal.copy(t),this.constant=e,this}setComponents(t,e,n,s){return this.normal.set(t,e,n),this.constant=s,this}setFromNormalAndCoplanarPoint(t,e){return this.normal.copy(t),this.constant=-e.dot(this.normal),this}setFromCoplanarPoints(t,e,n){const s=Zl.subVectors(n,e).cross(t0.subVectors(t,e)).normalize();return this.setFromNormalAndCoplanarPoint(s,t),this}copy(t){return this.normal.copy(t.normal),this.constant=t.constant,this}normalize(){const t=1/this.normal.length();return this.normal.multiplyScalar(t),this.constant*=t,this}negate(){return this.constant*=-1,this.normal.negate(),this}distanceToPoint(t){return this.normal.dot(t)+this.constant}distanceToSphere(t){return this.distanceToPoint(t.center)-t.radius}projectPoint(t,e){return e.copy(t).addScaledVector(this.normal,-this.distanceToPoint(t))}intersectLine(t,e){const n=t.delta(Zl),s=this.normal.dot(n);if(s===0)return this.distanceToPoint(t.start)===0?e.copy(t.start):null;const r=-(t.start.dot(this.normal)+this.constant)/s;return r<0||r>1?null:e.copy(t.start).addScaledVector(n,r)}intersectsLine(t){const e=this.distanceToPoint(t.start),n=this.distanceToPoint(t.end);return e<0&&n>0||n<0&&e>0}intersectsBox(t){return t.intersectsPlane(this)}intersectsSphere(t){return t.intersectsPlane(this)}coplanarPoint(t){return t.copy(this.normal).multiplyScalar(-this.constant)}applyMatrix4(t,e){const n=e||e0.getNormalMatrix(t),s=this.coplanarPoint(Zl).applyMatrix4(t),r=this.normal.applyMatrix3(n).normalize();return this.constant=-s.dot(r),this}translate(t){return this.constant-=t.dot(this.normal),this}equals(t){return t.normal.equals(this.normal)&&t.constant===this.constant}clone(){return new this.constructor().copy(this)}}const Ss=new el,ao=new j;class Bh{constructor(t=new es,e=new es,n=new es,s=new es,r=new es,a=new es){this.planes=[t,e,n,s,r,a]}set(t,e,n,s,r,a){const o=this.planes;return o[0].copy(t),o[1].copy(e),o[2].copy(n),o[3].copy(s),o[4].copy(r),o[5].copy(a),this}copy(t){const e=this.planes;for(let n=0;n<6;n++)e[n].copy(t.planes[n]);return this}setFromProjectionMatrix(t,e=zi){const n=this.planes,s=t.elements,r=s[0],a=s[1],o=s[2],l=s[3],c=s[4],u=s[5],f=s[6],h=s[7],_=s[8],x=s[9],M=s[10],p=s[11],d=s[12],C=s[13],b=s[14],R=s[15];if(n[0].setComponents(l-r,h-c,p-_,R-d).normalize(),n[1].setComponents(l+r,h+c,p+_,R+d).normalize(),n[2].setComponents(l+a,h+u,p+x,R+C).normalize(),n[3].setComponents(l-a,h-u,p-x,R-C).normalize(),n[4].setComponents(l-o,h-f,p-M,R-b).normalize(),e===zi)n[5].setComponents(l+o,h+f,p+M,R+b).normalize();else if(e===Vo)n[5].setComponents(o,f,M,b).normalize();else throw new Error("THREE.Frustum.setFromProjectionMatrix(): Invalid coordinate system: "+e);return this}intersectsObject(t){if(t.boundingSphere!==void 0)t.boundingSphere===null&&t.computeBoundingSphere(),Ss.copy(t.boundingSphere).applyMatrix4(t.matrixWorld);else{const e=t.geometry;e.boundingSphere===null&&e.computeBoundingSphere(),Ss.copy(e.boundingSphere).applyMatrix4(t.matrixWorld)}return this.intersectsSphere(Ss)}intersectsSprite(t){return Ss.center.set(0,0,0),Ss.radius=.7071067811865476,Ss.applyMatrix4(t.matrixWorld),this.intersectsSphere(Ss)}intersectsSphere(t){const e=this.planes,n=t.center,s=-t.radius;for(let r=0;r<6;r++)if(e[r].distanceToPoint(n)<s)return!1;return!0}intersectsBox(t){const e=this.planes;for(let n=0;n<6;n++){const s=e[n];if(ao.x=s.normal.x>0?t.max.x:t.min.x,ao.y=s.normal.y>0?t.max.y:t.min.y,ao.z=s.normal.z>0?t.max.z:t.min.z,s.distanceToPoint(ao)<0)return!1}return!0}containsPoint(t){const e=this.planes;for(let n=0;n<6;n++)if(e[n].distanceToPoint(t)<0)return!1;return!0}clone(){return new this.constructor().copy(this)}}function yp(){let i=null,t=!1,e=null,n=null;function s(r,a){e(r,a),n=i.requestAnimationFrame(s)}return{start:function(){t!==!0&&e!==null&&(n=i.requestAnimationFrame(s),t=!0)},stop:function(){i.cancelAnimationFrame(n),t=!1},setAnimationLoop:function(r){e=r},setContext:function(r){i=r}}}function n0(i){const t=new WeakMap;function e(o,l){const c=o.array,u=o.usage,f=c.byteLength,h=i.createBuffer();i.bindBuffer(l,h),i.bufferData(l,c,u),o.onUploadCallback();let _;if(c instanceof Float32Array)_=i.FLOAT;else if(c instanceof Uint16Array)o.isFloat16BufferAttribute?_=i.HALF_FLOAT:_=i.UNSIGNED_SHORT;else if(c instanceof Int16Array)_=i.SHORT;else if(c instanceof Uint32Array)_=i.UNSIGNED_INT;else if(c instanceof Int32Array)_=i.INT;else if(c instanceof Int8Array)_=i.BYTE;else if(c instanceof Uint8Array)_=i.UNSIGNED_BYTE;else if(c instanceof Uint8ClampedArray)_=i.UNSIGNED_BYTE;else throw new Error("THREE.WebGLAttributes: Unsupported buffer data format: "+c);return{buffer:h,type:_,bytesPerElement:c.BYTES_PER_ELEMENT,version:o.version,size:f}}function n(o,l,c){const u=l.array,f=l.updateRanges;if(i.bindBuffer(c,o),f.length===0)i.bufferSubData(c,0,u);else{f.sort((_,x)=>_.start-x.start);let h=0;for(let _=1;_<f.length;_++){const x=f[h],M=f[_];M.start<=x.start+x.count+1?x.count=Math.max(x.count,M.start+M.count-x.start):(++h,f[h]=M)}f.length=h+1;for(let _=0,x=f.length;_<x;_++){const M=f[_];i.bufferSubData(c,M.start*u.BYTES_PER_ELEMENT,u,M.start,M.count)}l.clearUpdateRanges()}l.onUploadCallback()}function s(o){return o.isInterleavedBufferAttribute&&(o=o.data),t.get(o)}function r(o){o.isInterleavedBufferAttribute&&(o=o.data);const l=t.get(o);l&&(i.deleteBuffer(l.buffer),t.delete(o))}function a(o,l){if(o.isInterleavedBufferAttribute&&(o=o.data),o.isGLBufferAttribute){const u=t.get(o);(!u||u.version<o.version)&&t.set(o,{buffer:o.buffer,type:o.type,bytesPerElement:o.elementSize,version:o.version});return}const c=t.get(o);if(c===void 0)t.set(o,e(o,l));else if(c.version<o.version){if(c.size!==o.array.byteLength)throw new Error("THREE.WebGLAttributes: The size of the buffer attribute's array buffer does not match the original size. Resizing buffer attributes is not supported.");n(c.buffer,o,l),c.version=o.version}}return{get:s,remove:r,update:a}}class nl extends gn{constructor(t=1,e=1,n=1,s=1){super(),this.type="PlaneGeometry",this.parameters={width:t,height:e,widthSegments:n,heightSegments:s};const r=t/2,a=e/2,o=Math.floor(n),l=Math.floor(s),c=o+1,u=l+1,f=t/o,h=e/l,_=[],x=[],M=[],p=[];for(let d=0;d<u;d++){const C=d*h-a;for(let b=0;b<c;b++){const R=b*f-r;x.push(R,-C,0),M.push(0,0,1),p.push(b/o),p.push(1-d/l)}}for(let d=0;d<l;d++)for(let C=0;C<o;C++){const b=C+c*d,R=C+c*(d+1),D=C+1+c*(d+1),A=C+1+c*d;_.push(b,R,A),_.push(R,D,A)}this.setIndex(_),this.setAttribute("position",new Be(x,3)),this.setAttribute("normal",new Be(M,3)),this.setAttribute("uv",new Be(p,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new nl(t.width,t.height,t.widthSegments,t.heightSegments)}}var i0=`#ifdef USE_ALPHAHASH
	if ( diffuseColor.a < getAlphaHashThreshold( vPosition ) ) discard;
#endif`,s0=`#ifdef USE_ALPHAHASH
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
#endif`,r0=`#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, vAlphaMapUv ).g;
#endif`,a0=`#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,o0=`#ifdef USE_ALPHATEST
	#ifdef ALPHA_TO_COVERAGE
	diffuseColor.a = smoothstep( alphaTest, alphaTest + fwidth( diffuseColor.a ), diffuseColor.a );
	if ( diffuseColor.a == 0.0 ) discard;
	#else
	if ( diffuseColor.a < alphaTest ) discard;
	#endif
#endif`,l0=`#ifdef USE_ALPHATEST
	uniform float alphaTest;
#endif`,c0=`#ifdef USE_AOMAP
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
#endif`,h0=`#ifdef USE_AOMAP
	uniform sampler2D aoMap;
	uniform float aoMapIntensity;
#endif`,u0=`#ifdef USE_BATCHING
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
#endif`,f0=`#ifdef USE_BATCHING
	mat4 batchingMatrix = getBatchingMatrix( getIndirectIndex( gl_DrawID ) );
#endif`,d0=`vec3 transformed = vec3( position );
#ifdef USE_ALPHAHASH
	vPosition = vec3( position );
#endif`,p0=`vec3 objectNormal = vec3( normal );
#ifdef USE_TANGENT
	vec3 objectTangent = vec3( tangent.xyz );
#endif`,m0=`float G_BlinnPhong_Implicit( ) {
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
} // validated`,g0=`#ifdef USE_IRIDESCENCE
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
#endif`,_0=`#ifdef USE_BUMPMAP
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
#endif`,v0=`#if NUM_CLIPPING_PLANES > 0
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
#endif`,x0=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
	uniform vec4 clippingPlanes[ NUM_CLIPPING_PLANES ];
#endif`,M0=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
#endif`,y0=`#if NUM_CLIPPING_PLANES > 0
	vClipPosition = - mvPosition.xyz;
#endif`,S0=`#if defined( USE_COLOR_ALPHA )
	diffuseColor *= vColor;
#elif defined( USE_COLOR )
	diffuseColor.rgb *= vColor;
#endif`,E0=`#if defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#elif defined( USE_COLOR )
	varying vec3 vColor;
#endif`,w0=`#if defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#elif defined( USE_COLOR ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	varying vec3 vColor;
#endif`,b0=`#if defined( USE_COLOR_ALPHA )
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
#endif`,T0=`#define PI 3.141592653589793
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
} // validated`,A0=`#ifdef ENVMAP_TYPE_CUBE_UV
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
#endif`,R0=`vec3 transformedNormal = objectNormal;
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
#endif`,C0=`#ifdef USE_DISPLACEMENTMAP
	uniform sampler2D displacementMap;
	uniform float displacementScale;
	uniform float displacementBias;
#endif`,P0=`#ifdef USE_DISPLACEMENTMAP
	transformed += normalize( objectNormal ) * ( texture2D( displacementMap, vDisplacementMapUv ).x * displacementScale + displacementBias );
#endif`,L0=`#ifdef USE_EMISSIVEMAP
	vec4 emissiveColor = texture2D( emissiveMap, vEmissiveMapUv );
	totalEmissiveRadiance *= emissiveColor.rgb;
#endif`,D0=`#ifdef USE_EMISSIVEMAP
	uniform sampler2D emissiveMap;
#endif`,I0="gl_FragColor = linearToOutputTexel( gl_FragColor );",U0=`
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
}`,N0=`#ifdef USE_ENVMAP
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
#endif`,k0=`#ifdef USE_ENVMAP
	uniform float envMapIntensity;
	uniform float flipEnvMap;
	uniform mat3 envMapRotation;
	#ifdef ENVMAP_TYPE_CUBE
		uniform samplerCube envMap;
	#else
		uniform sampler2D envMap;
	#endif
	
#endif`,O0=`#ifdef USE_ENVMAP
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
#endif`,F0=`#ifdef USE_ENVMAP
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		
		varying vec3 vWorldPosition;
	#else
		varying vec3 vReflect;
		uniform float refractionRatio;
	#endif
#endif`,B0=`#ifdef USE_ENVMAP
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
#endif`,z0=`#ifdef USE_FOG
	vFogDepth = - mvPosition.z;
#endif`,H0=`#ifdef USE_FOG
	varying float vFogDepth;
#endif`,G0=`#ifdef USE_FOG
	#ifdef FOG_EXP2
		float fogFactor = 1.0 - exp( - fogDensity * fogDensity * vFogDepth * vFogDepth );
	#else
		float fogFactor = smoothstep( fogNear, fogFar, vFogDepth );
	#endif
	gl_FragColor.rgb = mix( gl_FragColor.rgb, fogColor, fogFactor );
#endif`,V0=`#ifdef USE_FOG
	uniform vec3 fogColor;
	varying float vFogDepth;
	#ifdef FOG_EXP2
		uniform float fogDensity;
	#else
		uniform float fogNear;
		uniform float fogFar;
	#endif
#endif`,W0=`#ifdef USE_GRADIENTMAP
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
}`,X0=`#ifdef USE_LIGHTMAP
	uniform sampler2D lightMap;
	uniform float lightMapIntensity;
#endif`,q0=`LambertMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularStrength = specularStrength;`,Y0=`varying vec3 vViewPosition;
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
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Lambert`,j0=`uniform bool receiveShadow;
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
#endif`,K0=`#ifdef USE_ENVMAP
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
#endif`,$0=`ToonMaterial material;
material.diffuseColor = diffuseColor.rgb;`,Z0=`varying vec3 vViewPosition;
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
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Toon`,J0=`BlinnPhongMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularColor = specular;
material.specularShininess = shininess;
material.specularStrength = specularStrength;`,Q0=`varying vec3 vViewPosition;
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
#define RE_IndirectDiffuse		RE_IndirectDiffuse_BlinnPhong`,tv=`PhysicalMaterial material;
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
#endif`,ev=`struct PhysicalMaterial {
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
}`,nv=`
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
#endif`,iv=`#if defined( RE_IndirectDiffuse )
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
#endif`,sv=`#if defined( RE_IndirectDiffuse )
	RE_IndirectDiffuse( irradiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif
#if defined( RE_IndirectSpecular )
	RE_IndirectSpecular( radiance, iblIrradiance, clearcoatRadiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif`,rv=`#if defined( USE_LOGDEPTHBUF )
	gl_FragDepth = vIsPerspective == 0.0 ? gl_FragCoord.z : log2( vFragDepth ) * logDepthBufFC * 0.5;
#endif`,av=`#if defined( USE_LOGDEPTHBUF )
	uniform float logDepthBufFC;
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,ov=`#ifdef USE_LOGDEPTHBUF
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,lv=`#ifdef USE_LOGDEPTHBUF
	vFragDepth = 1.0 + gl_Position.w;
	vIsPerspective = float( isPerspectiveMatrix( projectionMatrix ) );
#endif`,cv=`#ifdef USE_MAP
	vec4 sampledDiffuseColor = texture2D( map, vMapUv );
	#ifdef DECODE_VIDEO_TEXTURE
		sampledDiffuseColor = vec4( mix( pow( sampledDiffuseColor.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), sampledDiffuseColor.rgb * 0.0773993808, vec3( lessThanEqual( sampledDiffuseColor.rgb, vec3( 0.04045 ) ) ) ), sampledDiffuseColor.w );
	
	#endif
	diffuseColor *= sampledDiffuseColor;
#endif`,hv=`#ifdef USE_MAP
	uniform sampler2D map;
#endif`,uv=`#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
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
#endif`,fv=`#if defined( USE_POINTS_UV )
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
#endif`,dv=`float metalnessFactor = metalness;
#ifdef USE_METALNESSMAP
	vec4 texelMetalness = texture2D( metalnessMap, vMetalnessMapUv );
	metalnessFactor *= texelMetalness.b;
#endif`,pv=`#ifdef USE_METALNESSMAP
	uniform sampler2D metalnessMap;
#endif`,mv=`#ifdef USE_INSTANCING_MORPH
	float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	float morphTargetBaseInfluence = texelFetch( morphTexture, ivec2( 0, gl_InstanceID ), 0 ).r;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		morphTargetInfluences[i] =  texelFetch( morphTexture, ivec2( i + 1, gl_InstanceID ), 0 ).r;
	}
#endif`,gv=`#if defined( USE_MORPHCOLORS )
	vColor *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		#if defined( USE_COLOR_ALPHA )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor += getMorph( gl_VertexID, i, 2 ) * morphTargetInfluences[ i ];
		#elif defined( USE_COLOR )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor += getMorph( gl_VertexID, i, 2 ).rgb * morphTargetInfluences[ i ];
		#endif
	}
#endif`,_v=`#ifdef USE_MORPHNORMALS
	objectNormal *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) objectNormal += getMorph( gl_VertexID, i, 1 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,vv=`#ifdef USE_MORPHTARGETS
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
#endif`,xv=`#ifdef USE_MORPHTARGETS
	transformed *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) transformed += getMorph( gl_VertexID, i, 0 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,Mv=`float faceDirection = gl_FrontFacing ? 1.0 : - 1.0;
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
vec3 nonPerturbedNormal = normal;`,yv=`#ifdef USE_NORMALMAP_OBJECTSPACE
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
#endif`,Sv=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,Ev=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,wv=`#ifndef FLAT_SHADED
	vNormal = normalize( transformedNormal );
	#ifdef USE_TANGENT
		vTangent = normalize( transformedTangent );
		vBitangent = normalize( cross( vNormal, vTangent ) * tangent.w );
	#endif
#endif`,bv=`#ifdef USE_NORMALMAP
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
#endif`,Tv=`#ifdef USE_CLEARCOAT
	vec3 clearcoatNormal = nonPerturbedNormal;
#endif`,Av=`#ifdef USE_CLEARCOAT_NORMALMAP
	vec3 clearcoatMapN = texture2D( clearcoatNormalMap, vClearcoatNormalMapUv ).xyz * 2.0 - 1.0;
	clearcoatMapN.xy *= clearcoatNormalScale;
	clearcoatNormal = normalize( tbn2 * clearcoatMapN );
#endif`,Rv=`#ifdef USE_CLEARCOATMAP
	uniform sampler2D clearcoatMap;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform sampler2D clearcoatNormalMap;
	uniform vec2 clearcoatNormalScale;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform sampler2D clearcoatRoughnessMap;
#endif`,Cv=`#ifdef USE_IRIDESCENCEMAP
	uniform sampler2D iridescenceMap;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform sampler2D iridescenceThicknessMap;
#endif`,Pv=`#ifdef OPAQUE
diffuseColor.a = 1.0;
#endif
#ifdef USE_TRANSMISSION
diffuseColor.a *= material.transmissionAlpha;
#endif
gl_FragColor = vec4( outgoingLight, diffuseColor.a );`,Lv=`vec3 packNormalToRGB( const in vec3 normal ) {
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
}`,Dv=`#ifdef PREMULTIPLIED_ALPHA
	gl_FragColor.rgb *= gl_FragColor.a;
#endif`,Iv=`vec4 mvPosition = vec4( transformed, 1.0 );
#ifdef USE_BATCHING
	mvPosition = batchingMatrix * mvPosition;
#endif
#ifdef USE_INSTANCING
	mvPosition = instanceMatrix * mvPosition;
#endif
mvPosition = modelViewMatrix * mvPosition;
gl_Position = projectionMatrix * mvPosition;`,Uv=`#ifdef DITHERING
	gl_FragColor.rgb = dithering( gl_FragColor.rgb );
#endif`,Nv=`#ifdef DITHERING
	vec3 dithering( vec3 color ) {
		float grid_position = rand( gl_FragCoord.xy );
		vec3 dither_shift_RGB = vec3( 0.25 / 255.0, -0.25 / 255.0, 0.25 / 255.0 );
		dither_shift_RGB = mix( 2.0 * dither_shift_RGB, -2.0 * dither_shift_RGB, grid_position );
		return color + dither_shift_RGB;
	}
#endif`,kv=`float roughnessFactor = roughness;
#ifdef USE_ROUGHNESSMAP
	vec4 texelRoughness = texture2D( roughnessMap, vRoughnessMapUv );
	roughnessFactor *= texelRoughness.g;
#endif`,Ov=`#ifdef USE_ROUGHNESSMAP
	uniform sampler2D roughnessMap;
#endif`,Fv=`#if NUM_SPOT_LIGHT_COORDS > 0
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
#endif`,Bv=`#if NUM_SPOT_LIGHT_COORDS > 0
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
#endif`,zv=`#if ( defined( USE_SHADOWMAP ) && ( NUM_DIR_LIGHT_SHADOWS > 0 || NUM_POINT_LIGHT_SHADOWS > 0 ) ) || ( NUM_SPOT_LIGHT_COORDS > 0 )
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
#endif`,Hv=`float getShadowMask() {
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
}`,Gv=`#ifdef USE_SKINNING
	mat4 boneMatX = getBoneMatrix( skinIndex.x );
	mat4 boneMatY = getBoneMatrix( skinIndex.y );
	mat4 boneMatZ = getBoneMatrix( skinIndex.z );
	mat4 boneMatW = getBoneMatrix( skinIndex.w );
#endif`,Vv=`#ifdef USE_SKINNING
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
#endif`,Wv=`#ifdef USE_SKINNING
	vec4 skinVertex = bindMatrix * vec4( transformed, 1.0 );
	vec4 skinned = vec4( 0.0 );
	skinned += boneMatX * skinVertex * skinWeight.x;
	skinned += boneMatY * skinVertex * skinWeight.y;
	skinned += boneMatZ * skinVertex * skinWeight.z;
	skinned += boneMatW * skinVertex * skinWeight.w;
	transformed = ( bindMatrixInverse * skinned ).xyz;
#endif`,Xv=`#ifdef USE_SKINNING
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
#endif`,qv=`float specularStrength;
#ifdef USE_SPECULARMAP
	vec4 texelSpecular = texture2D( specularMap, vSpecularMapUv );
	specularStrength = texelSpecular.r;
#else
	specularStrength = 1.0;
#endif`,Yv=`#ifdef USE_SPECULARMAP
	uniform sampler2D specularMap;
#endif`,jv=`#if defined( TONE_MAPPING )
	gl_FragColor.rgb = toneMapping( gl_FragColor.rgb );
#endif`,Kv=`#ifndef saturate
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
vec3 CustomToneMapping( vec3 color ) { return color; }`,$v=`#ifdef USE_TRANSMISSION
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
#endif`,Zv=`#ifdef USE_TRANSMISSION
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
#endif`,Jv=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
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
#endif`,Qv=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
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
#endif`,tx=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
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
#endif`,ex=`#if defined( USE_ENVMAP ) || defined( DISTANCE ) || defined ( USE_SHADOWMAP ) || defined ( USE_TRANSMISSION ) || NUM_SPOT_LIGHT_COORDS > 0
	vec4 worldPosition = vec4( transformed, 1.0 );
	#ifdef USE_BATCHING
		worldPosition = batchingMatrix * worldPosition;
	#endif
	#ifdef USE_INSTANCING
		worldPosition = instanceMatrix * worldPosition;
	#endif
	worldPosition = modelMatrix * worldPosition;
#endif`;const nx=`varying vec2 vUv;
uniform mat3 uvTransform;
void main() {
	vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	gl_Position = vec4( position.xy, 1.0, 1.0 );
}`,ix=`uniform sampler2D t2D;
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
}`,sx=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,rx=`#ifdef ENVMAP_TYPE_CUBE
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
}`,ax=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,ox=`uniform samplerCube tCube;
uniform float tFlip;
uniform float opacity;
varying vec3 vWorldDirection;
void main() {
	vec4 texColor = textureCube( tCube, vec3( tFlip * vWorldDirection.x, vWorldDirection.yz ) );
	gl_FragColor = texColor;
	gl_FragColor.a *= opacity;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,lx=`#include <common>
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
}`,cx=`#if DEPTH_PACKING == 3200
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
}`,hx=`#define DISTANCE
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
}`,ux=`#define DISTANCE
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
}`,fx=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
}`,dx=`uniform sampler2D tEquirect;
varying vec3 vWorldDirection;
#include <common>
void main() {
	vec3 direction = normalize( vWorldDirection );
	vec2 sampleUV = equirectUv( direction );
	gl_FragColor = texture2D( tEquirect, sampleUV );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,px=`uniform float scale;
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
}`,mx=`uniform vec3 diffuse;
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
}`,gx=`#include <common>
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
}`,_x=`uniform vec3 diffuse;
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
}`,vx=`#define LAMBERT
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
}`,xx=`#define LAMBERT
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
}`,Mx=`#define MATCAP
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
}`,yx=`#define MATCAP
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
}`,Sx=`#define NORMAL
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
}`,Ex=`#define NORMAL
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
}`,wx=`#define PHONG
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
}`,bx=`#define PHONG
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
}`,Tx=`#define STANDARD
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
}`,Ax=`#define STANDARD
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
}`,Rx=`#define TOON
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
}`,Cx=`#define TOON
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
}`,Px=`uniform float size;
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
}`,Lx=`uniform vec3 diffuse;
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
}`,Dx=`#include <common>
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
}`,Ix=`uniform vec3 color;
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
}`,Ux=`uniform float rotation;
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
}`,Nx=`uniform vec3 diffuse;
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
}`,ae={alphahash_fragment:i0,alphahash_pars_fragment:s0,alphamap_fragment:r0,alphamap_pars_fragment:a0,alphatest_fragment:o0,alphatest_pars_fragment:l0,aomap_fragment:c0,aomap_pars_fragment:h0,batching_pars_vertex:u0,batching_vertex:f0,begin_vertex:d0,beginnormal_vertex:p0,bsdfs:m0,iridescence_fragment:g0,bumpmap_pars_fragment:_0,clipping_planes_fragment:v0,clipping_planes_pars_fragment:x0,clipping_planes_pars_vertex:M0,clipping_planes_vertex:y0,color_fragment:S0,color_pars_fragment:E0,color_pars_vertex:w0,color_vertex:b0,common:T0,cube_uv_reflection_fragment:A0,defaultnormal_vertex:R0,displacementmap_pars_vertex:C0,displacementmap_vertex:P0,emissivemap_fragment:L0,emissivemap_pars_fragment:D0,colorspace_fragment:I0,colorspace_pars_fragment:U0,envmap_fragment:N0,envmap_common_pars_fragment:k0,envmap_pars_fragment:O0,envmap_pars_vertex:F0,envmap_physical_pars_fragment:K0,envmap_vertex:B0,fog_vertex:z0,fog_pars_vertex:H0,fog_fragment:G0,fog_pars_fragment:V0,gradientmap_pars_fragment:W0,lightmap_pars_fragment:X0,lights_lambert_fragment:q0,lights_lambert_pars_fragment:Y0,lights_pars_begin:j0,lights_toon_fragment:$0,lights_toon_pars_fragment:Z0,lights_phong_fragment:J0,lights_phong_pars_fragment:Q0,lights_physical_fragment:tv,lights_physical_pars_fragment:ev,lights_fragment_begin:nv,lights_fragment_maps:iv,lights_fragment_end:sv,logdepthbuf_fragment:rv,logdepthbuf_pars_fragment:av,logdepthbuf_pars_vertex:ov,logdepthbuf_vertex:lv,map_fragment:cv,map_pars_fragment:hv,map_particle_fragment:uv,map_particle_pars_fragment:fv,metalnessmap_fragment:dv,metalnessmap_pars_fragment:pv,morphinstance_vertex:mv,morphcolor_vertex:gv,morphnormal_vertex:_v,morphtarget_pars_vertex:vv,morphtarget_vertex:xv,normal_fragment_begin:Mv,normal_fragment_maps:yv,normal_pars_fragment:Sv,normal_pars_vertex:Ev,normal_vertex:wv,normalmap_pars_fragment:bv,clearcoat_normal_fragment_begin:Tv,clearcoat_normal_fragment_maps:Av,clearcoat_pars_fragment:Rv,iridescence_pars_fragment:Cv,opaque_fragment:Pv,packing:Lv,premultiplied_alpha_fragment:Dv,project_vertex:Iv,dithering_fragment:Uv,dithering_pars_fragment:Nv,roughnessmap_fragment:kv,roughnessmap_pars_fragment:Ov,shadowmap_pars_fragment:Fv,shadowmap_pars_vertex:Bv,shadowmap_vertex:zv,shadowmask_pars_fragment:Hv,skinbase_vertex:Gv,skinning_pars_vertex:Vv,skinning_vertex:Wv,skinnormal_vertex:Xv,specularmap_fragment:qv,specularmap_pars_fragment:Yv,tonemapping_fragment:jv,tonemapping_pars_fragment:Kv,transmission_fragment:$v,transmission_pars_fragment:Zv,uv_pars_fragment:Jv,uv_pars_vertex:Qv,uv_vertex:tx,worldpos_vertex:ex,background_vert:nx,background_frag:ix,backgroundCube_vert:sx,backgroundCube_frag:rx,cube_vert:ax,cube_frag:ox,depth_vert:lx,depth_frag:cx,distanceRGBA_vert:hx,distanceRGBA_frag:ux,equirect_vert:fx,equirect_frag:dx,linedashed_vert:px,linedashed_frag:mx,meshbasic_vert:gx,meshbasic_frag:_x,meshlambert_vert:vx,meshlambert_frag:xx,meshmatcap_vert:Mx,meshmatcap_frag:yx,meshnormal_vert:Sx,meshnormal_frag:Ex,meshphong_vert:wx,meshphong_frag:bx,meshphysical_vert:Tx,meshphysical_frag:Ax,meshtoon_vert:Rx,meshtoon_frag:Cx,points_vert:Px,points_frag:Lx,shadow_vert:Dx,shadow_frag:Ix,sprite_vert:Ux,sprite_frag:Nx},Pt={common:{diffuse:{value:new ne(16777215)},opacity:{value:1},map:{value:null},mapTransform:{value:new oe},alphaMap:{value:null},alphaMapTransform:{value:new oe},alphaTest:{value:0}},specularmap:{specularMap:{value:null},specularMapTransform:{value:new oe}},envmap:{envMap:{value:null},envMapRotation:{value:new oe},flipEnvMap:{value:-1},reflectivity:{value:1},ior:{value:1.5},refractionRatio:{value:.98}},aomap:{aoMap:{value:null},aoMapIntensity:{value:1},aoMapTransform:{value:new oe}},lightmap:{lightMap:{value:null},lightMapIntensity:{value:1},lightMapTransform:{value:new oe}},bumpmap:{bumpMap:{value:null},bumpMapTransform:{value:new oe},bumpScale:{value:1}},normalmap:{normalMap:{value:null},normalMapTransform:{value:new oe},normalScale:{value:new Qt(1,1)}},displacementmap:{displacementMap:{value:null},displacementMapTransform:{value:new oe},displacementScale:{value:1},displacementBias:{value:0}},emissivemap:{emissiveMap:{value:null},emissiveMapTransform:{value:new oe}},metalnessmap:{metalnessMap:{value:null},metalnessMapTransform:{value:new oe}},roughnessmap:{roughnessMap:{value:null},roughnessMapTransform:{value:new oe}},gradientmap:{gradientMap:{value:null}},fog:{fogDensity:{value:25e-5},fogNear:{value:1},fogFar:{value:2e3},fogColor:{value:new ne(16777215)}},lights:{ambientLightColor:{value:[]},lightProbe:{value:[]},directionalLights:{value:[],properties:{direction:{},color:{}}},directionalLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},directionalShadowMap:{value:[]},directionalShadowMatrix:{value:[]},spotLights:{value:[],properties:{color:{},position:{},direction:{},distance:{},coneCos:{},penumbraCos:{},decay:{}}},spotLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},spotLightMap:{value:[]},spotShadowMap:{value:[]},spotLightMatrix:{value:[]},pointLights:{value:[],properties:{color:{},position:{},decay:{},distance:{}}},pointLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{},shadowCameraNear:{},shadowCameraFar:{}}},pointShadowMap:{value:[]},pointShadowMatrix:{value:[]},hemisphereLights:{value:[],properties:{direction:{},skyColor:{},groundColor:{}}},rectAreaLights:{value:[],properties:{color:{},position:{},width:{},height:{}}},ltc_1:{value:null},ltc_2:{value:null}},points:{diffuse:{value:new ne(16777215)},opacity:{value:1},size:{value:1},scale:{value:1},map:{value:null},alphaMap:{value:null},alphaMapTransform:{value:new oe},alphaTest:{value:0},uvTransform:{value:new oe}},sprite:{diffuse:{value:new ne(16777215)},opacity:{value:1},center:{value:new Qt(.5,.5)},rotation:{value:0},map:{value:null},mapTransform:{value:new oe},alphaMap:{value:null},alphaMapTransform:{value:new oe},alphaTest:{value:0}}},Si={basic:{uniforms:Cn([Pt.common,Pt.specularmap,Pt.envmap,Pt.aomap,Pt.lightmap,Pt.fog]),vertexShader:ae.meshbasic_vert,fragmentShader:ae.meshbasic_frag},lambert:{uniforms:Cn([Pt.common,Pt.specularmap,Pt.envmap,Pt.aomap,Pt.lightmap,Pt.emissivemap,Pt.bumpmap,Pt.normalmap,Pt.displacementmap,Pt.fog,Pt.lights,{emissive:{value:new ne(0)}}]),vertexShader:ae.meshlambert_vert,fragmentShader:ae.meshlambert_frag},phong:{uniforms:Cn([Pt.common,Pt.specularmap,Pt.envmap,Pt.aomap,Pt.lightmap,Pt.emissivemap,Pt.bumpmap,Pt.normalmap,Pt.displacementmap,Pt.fog,Pt.lights,{emissive:{value:new ne(0)},specular:{value:new ne(1118481)},shininess:{value:30}}]),vertexShader:ae.meshphong_vert,fragmentShader:ae.meshphong_frag},standard:{uniforms:Cn([Pt.common,Pt.envmap,Pt.aomap,Pt.lightmap,Pt.emissivemap,Pt.bumpmap,Pt.normalmap,Pt.displacementmap,Pt.roughnessmap,Pt.metalnessmap,Pt.fog,Pt.lights,{emissive:{value:new ne(0)},roughness:{value:1},metalness:{value:0},envMapIntensity:{value:1}}]),vertexShader:ae.meshphysical_vert,fragmentShader:ae.meshphysical_frag},toon:{uniforms:Cn([Pt.common,Pt.aomap,Pt.lightmap,Pt.emissivemap,Pt.bumpmap,Pt.normalmap,Pt.displacementmap,Pt.gradientmap,Pt.fog,Pt.lights,{emissive:{value:new ne(0)}}]),vertexShader:ae.meshtoon_vert,fragmentShader:ae.meshtoon_frag},matcap:{uniforms:Cn([Pt.common,Pt.bumpmap,Pt.normalmap,Pt.displacementmap,Pt.fog,{matcap:{value:null}}]),vertexShader:ae.meshmatcap_vert,fragmentShader:ae.meshmatcap_frag},points:{uniforms:Cn([Pt.points,Pt.fog]),vertexShader:ae.points_vert,fragmentShader:ae.points_frag},dashed:{uniforms:Cn([Pt.common,Pt.fog,{scale:{value:1},dashSize:{value:1},totalSize:{value:2}}]),vertexShader:ae.linedashed_vert,fragmentShader:ae.linedashed_frag},depth:{uniforms:Cn([Pt.common,Pt.displacementmap]),vertexShader:ae.depth_vert,fragmentShader:ae.depth_frag},normal:{uniforms:Cn([Pt.common,Pt.bumpmap,Pt.normalmap,Pt.displacementmap,{opacity:{value:1}}]),vertexShader:ae.meshnormal_vert,fragmentShader:ae.meshnormal_frag},sprite:{uniforms:Cn([Pt.sprite,Pt.fog]),vertexShader:ae.sprite_vert,fragmentShader:ae.sprite_frag},background:{uniforms:{uvTransform:{value:new oe},t2D:{value:null},backgroundIntensity:{value:1}},vertexShader:ae.background_vert,fragmentShader:ae.background_frag},backgroundCube:{uniforms:{envMap:{value:null},flipEnvMap:{value:-1},backgroundBlurriness:{value:0},backgroundIntensity:{value:1},backgroundRotation:{value:new oe}},vertexShader:ae.backgroundCube_vert,fragmentShader:ae.backgroundCube_frag},cube:{uniforms:{tCube:{value:null},tFlip:{value:-1},opacity:{value:1}},vertexShader:ae.cube_vert,fragmentShader:ae.cube_frag},equirect:{uniforms:{tEquirect:{value:null}},vertexShader:ae.equirect_vert,fragmentShader:ae.equirect_frag},distanceRGBA:{uniforms:Cn([Pt.common,Pt.displacementmap,{referencePosition:{value:new j},nearDistance:{value:1},farDistance:{value:1e3}}]),vertexShader:ae.distanceRGBA_vert,fragmentShader:ae.distanceRGBA_frag},shadow:{uniforms:Cn([Pt.lights,Pt.fog,{color:{value:new ne(0)},opacity:{value:1}}]),vertexShader:ae.shadow_vert,fragmentShader:ae.shadow_frag}};Si.physical={uniforms:Cn([Si.standard.uniforms,{clearcoat:{value:0},clearcoatMap:{value:null},clearcoatMapTransform:{value:new oe},clearcoatNormalMap:{value:null},clearcoatNormalMapTransform:{value:new oe},clearcoatNormalScale:{value:new Qt(1,1)},clearcoatRoughness:{value:0},clearcoatRoughnessMap:{value:null},clearcoatRoughnessMapTransform:{value:new oe},dispersion:{value:0},iridescence:{value:0},iridescenceMap:{value:null},iridescenceMapTransform:{value:new oe},iridescenceIOR:{value:1.3},iridescenceThicknessMinimum:{value:100},iridescenceThicknessMaximum:{value:400},iridescenceThicknessMap:{value:null},iridescenceThicknessMapTransform:{value:new oe},sheen:{value:0},sheenColor:{value:new ne(0)},sheenColorMap:{value:null},sheenColorMapTransform:{value:new oe},sheenRoughness:{value:1},sheenRoughnessMap:{value:null},sheenRoughnessMapTransform:{value:new oe},transmission:{value:0},transmissionMap:{value:null},transmissionMapTransform:{value:new oe},transmissionSamplerSize:{value:new Qt},transmissionSamplerMap:{value:null},thickness:{value:0},thicknessMap:{value:null},thicknessMapTransform:{value:new oe},attenuationDistance:{value:0},attenuationColor:{value:new ne(0)},specularColor:{value:new ne(1,1,1)},specularColorMap:{value:null},specularColorMapTransform:{value:new oe},specularIntensity:{value:1},specularIntensityMap:{value:null},specularIntensityMapTransform:{value:new oe},anisotropyVector:{value:new Qt},anisotropyMap:{value:null},anisotropyMapTransform:{value:new oe}}]),vertexShader:ae.meshphysical_vert,fragmentShader:ae.meshphysical_frag};const oo={r:0,b:0,g:0},Es=new Ai,kx=new Ge;function Ox(i,t,e,n,s,r,a){const o=new ne(0);let l=r===!0?0:1,c,u,f=null,h=0,_=null;function x(C){let b=C.isScene===!0?C.background:null;return b&&b.isTexture&&(b=(C.backgroundBlurriness>0?e:t).get(b)),b}function M(C){let b=!1;const R=x(C);R===null?d(o,l):R&&R.isColor&&(d(R,1),b=!0);const D=i.xr.getEnvironmentBlendMode();D==="additive"?n.buffers.color.setClear(0,0,0,1,a):D==="alpha-blend"&&n.buffers.color.setClear(0,0,0,0,a),(i.autoClear||b)&&(n.buffers.depth.setTest(!0),n.buffers.depth.setMask(!0),n.buffers.color.setMask(!0),i.clear(i.autoClearColor,i.autoClearDepth,i.autoClearStencil))}function p(C,b){const R=x(b);R&&(R.isCubeTexture||R.mapping===Qo)?(u===void 0&&(u=new rn(new qr(1,1,1),new fs({name:"BackgroundCubeMaterial",uniforms:Br(Si.backgroundCube.uniforms),vertexShader:Si.backgroundCube.vertexShader,fragmentShader:Si.backgroundCube.fragmentShader,side:On,depthTest:!1,depthWrite:!1,fog:!1})),u.geometry.deleteAttribute("normal"),u.geometry.deleteAttribute("uv"),u.onBeforeRender=function(D,A,y){this.matrixWorld.copyPosition(y.matrixWorld)},Object.defineProperty(u.material,"envMap",{get:function(){return this.uniforms.envMap.value}}),s.update(u)),Es.copy(b.backgroundRotation),Es.x*=-1,Es.y*=-1,Es.z*=-1,R.isCubeTexture&&R.isRenderTargetTexture===!1&&(Es.y*=-1,Es.z*=-1),u.material.uniforms.envMap.value=R,u.material.uniforms.flipEnvMap.value=R.isCubeTexture&&R.isRenderTargetTexture===!1?-1:1,u.material.uniforms.backgroundBlurriness.value=b.backgroundBlurriness,u.material.uniforms.backgroundIntensity.value=b.backgroundIntensity,u.material.uniforms.backgroundRotation.value.setFromMatrix4(kx.makeRotationFromEuler(Es)),u.material.toneMapped=ye.getTransfer(R.colorSpace)!==Fe,(f!==R||h!==R.version||_!==i.toneMapping)&&(u.material.needsUpdate=!0,f=R,h=R.version,_=i.toneMapping),u.layers.enableAll(),C.unshift(u,u.geometry,u.material,0,0,null)):R&&R.isTexture&&(c===void 0&&(c=new rn(new nl(2,2),new fs({name:"BackgroundMaterial",uniforms:Br(Si.background.uniforms),vertexShader:Si.background.vertexShader,fragmentShader:Si.background.fragmentShader,side:us,depthTest:!1,depthWrite:!1,fog:!1})),c.geometry.deleteAttribute("normal"),Object.defineProperty(c.material,"map",{get:function(){return this.uniforms.t2D.value}}),s.update(c)),c.material.uniforms.t2D.value=R,c.material.uniforms.backgroundIntensity.value=b.backgroundIntensity,c.material.toneMapped=ye.getTransfer(R.colorSpace)!==Fe,R.matrixAutoUpdate===!0&&R.updateMatrix(),c.material.uniforms.uvTransform.value.copy(R.matrix),(f!==R||h!==R.version||_!==i.toneMapping)&&(c.material.needsUpdate=!0,f=R,h=R.version,_=i.toneMapping),c.layers.enableAll(),C.unshift(c,c.geometry,c.material,0,0,null))}function d(C,b){C.getRGB(oo,vp(i)),n.buffers.color.setClear(oo.r,oo.g,oo.b,b,a)}return{getClearColor:function(){return o},setClearColor:function(C,b=1){o.set(C),l=b,d(o,l)},getClearAlpha:function(){return l},setClearAlpha:function(C){l=C,d(o,l)},render:M,addToRenderList:p}}function Fx(i,t){const e=i.getParameter(i.MAX_VERTEX_ATTRIBS),n={},s=h(null);let r=s,a=!1;function o(g,m,E,N,F){let B=!1;const G=f(N,E,m);r!==G&&(r=G,c(r.object)),B=_(g,N,E,F),B&&x(g,N,E,F),F!==null&&t.update(F,i.ELEMENT_ARRAY_BUFFER),(B||a)&&(a=!1,R(g,m,E,N),F!==null&&i.bindBuffer(i.ELEMENT_ARRAY_BUFFER,t.get(F).buffer))}function l(){return i.createVertexArray()}function c(g){return i.bindVertexArray(g)}function u(g){return i.deleteVertexArray(g)}function f(g,m,E){const N=E.wireframe===!0;let F=n[g.id];F===void 0&&(F={},n[g.id]=F);let B=F[m.id];B===void 0&&(B={},F[m.id]=B);let G=B[N];return G===void 0&&(G=h(l()),B[N]=G),G}function h(g){const m=[],E=[],N=[];for(let F=0;F<e;F++)m[F]=0,E[F]=0,N[F]=0;return{geometry:null,program:null,wireframe:!1,newAttributes:m,enabledAttributes:E,attributeDivisors:N,object:g,attributes:{},index:null}}function _(g,m,E,N){const F=r.attributes,B=m.attributes;let G=0;const $=E.getAttributes();for(const Q in $)if($[Q].location>=0){const ct=F[Q];let gt=B[Q];if(gt===void 0&&(Q==="instanceMatrix"&&g.instanceMatrix&&(gt=g.instanceMatrix),Q==="instanceColor"&&g.instanceColor&&(gt=g.instanceColor)),ct===void 0||ct.attribute!==gt||gt&&ct.data!==gt.data)return!0;G++}return r.attributesNum!==G||r.index!==N}function x(g,m,E,N){const F={},B=m.attributes;let G=0;const $=E.getAttributes();for(const Q in $)if($[Q].location>=0){let ct=B[Q];ct===void 0&&(Q==="instanceMatrix"&&g.instanceMatrix&&(ct=g.instanceMatrix),Q==="instanceColor"&&g.instanceColor&&(ct=g.instanceColor));const gt={};gt.attribute=ct,ct&&ct.data&&(gt.data=ct.data),F[Q]=gt,G++}r.attributes=F,r.attributesNum=G,r.index=N}function M(){const g=r.newAttributes;for(let m=0,E=g.length;m<E;m++)g[m]=0}function p(g){d(g,0)}function d(g,m){const E=r.newAttributes,N=r.enabledAttributes,F=r.attributeDivisors;E[g]=1,N[g]===0&&(i.enableVertexAttribArray(g),N[g]=1),F[g]!==m&&(i.vertexAttribDivisor(g,m),F[g]=m)}function C(){const g=r.newAttributes,m=r.enabledAttributes;for(let E=0,N=m.length;E<N;E++)m[E]!==g[E]&&(i.disableVertexAttribArray(E),m[E]=0)}function b(g,m,E,N,F,B,G){G===!0?i.vertexAttribIPointer(g,m,E,F,B):i.vertexAttribPointer(g,m,E,N,F,B)}function R(g,m,E,N){M();const F=N.attributes,B=E.getAttributes(),G=m.defaultAttributeValues;for(const $ in B){const Q=B[$];if(Q.location>=0){let dt=F[$];if(dt===void 0&&($==="instanceMatrix"&&g.instanceMatrix&&(dt=g.instanceMatrix),$==="instanceColor"&&g.instanceColor&&(dt=g.instanceColor)),dt!==void 0){const ct=dt.normalized,gt=dt.itemSize,xt=t.get(dt);if(xt===void 0)continue;const Vt=xt.buffer,rt=xt.type,pt=xt.bytesPerElement,Dt=rt===i.INT||rt===i.UNSIGNED_INT||dt.gpuType===Lh;if(dt.isInterleavedBufferAttribute){const St=dt.data,Z=St.stride,J=dt.offset;if(St.isInstancedInterleavedBuffer){for(let Y=0;Y<Q.locationSize;Y++)d(Q.location+Y,St.meshPerAttribute);g.isInstancedMesh!==!0&&N._maxInstanceCount===void 0&&(N._maxInstanceCount=St.meshPerAttribute*St.count)}else for(let Y=0;Y<Q.locationSize;Y++)p(Q.location+Y);i.bindBuffer(i.ARRAY_BUFFER,Vt);for(let Y=0;Y<Q.locationSize;Y++)b(Q.location+Y,gt/Q.locationSize,rt,ct,Z*pt,(J+gt/Q.locationSize*Y)*pt,Dt)}else{if(dt.isInstancedBufferAttribute){for(let St=0;St<Q.locationSize;St++)d(Q.location+St,dt.meshPerAttribute);g.isInstancedMesh!==!0&&N._maxInstanceCount===void 0&&(N._maxInstanceCount=dt.meshPerAttribute*dt.count)}else for(let St=0;St<Q.locationSize;St++)p(Q.location+St);i.bindBuffer(i.ARRAY_BUFFER,Vt);for(let St=0;St<Q.locationSize;St++)b(Q.location+St,gt/Q.locationSize,rt,ct,gt*pt,gt/Q.locationSize*St*pt,Dt)}}else if(G!==void 0){const ct=G[$];if(ct!==void 0)switch(ct.length){case 2:i.vertexAttrib2fv(Q.location,ct);break;case 3:i.vertexAttrib3fv(Q.location,ct);break;case 4:i.vertexAttrib4fv(Q.location,ct);break;default:i.vertexAttrib1fv(Q.location,ct)}}}}C()}function D(){P();for(const g in n){const m=n[g];for(const E in m){const N=m[E];for(const F in N)u(N[F].object),delete N[F];delete m[E]}delete n[g]}}function A(g){if(n[g.id]===void 0)return;const m=n[g.id];for(const E in m){const N=m[E];for(const F in N)u(N[F].object),delete N[F];delete m[E]}delete n[g.id]}function y(g){for(const m in n){const E=n[m];if(E[g.id]===void 0)continue;const N=E[g.id];for(const F in N)u(N[F].object),delete N[F];delete E[g.id]}}function P(){O(),a=!0,r!==s&&(r=s,c(r.object))}function O(){s.geometry=null,s.program=null,s.wireframe=!1}return{setup:o,reset:P,resetDefaultState:O,dispose:D,releaseStatesOfGeometry:A,releaseStatesOfProgram:y,initAttributes:M,enableAttribute:p,disableUnusedAttributes:C}}function Bx(i,t,e){let n;function s(c){n=c}function r(c,u){i.drawArrays(n,c,u),e.update(u,n,1)}function a(c,u,f){f!==0&&(i.drawArraysInstanced(n,c,u,f),e.update(u,n,f))}function o(c,u,f){if(f===0)return;t.get("WEBGL_multi_draw").multiDrawArraysWEBGL(n,c,0,u,0,f);let _=0;for(let x=0;x<f;x++)_+=u[x];e.update(_,n,1)}function l(c,u,f,h){if(f===0)return;const _=t.get("WEBGL_multi_draw");if(_===null)for(let x=0;x<c.length;x++)a(c[x],u[x],h[x]);else{_.multiDrawArraysInstancedWEBGL(n,c,0,u,0,h,0,f);let x=0;for(let M=0;M<f;M++)x+=u[M];for(let M=0;M<h.length;M++)e.update(x,n,h[M])}}this.setMode=s,this.render=r,this.renderInstances=a,this.renderMultiDraw=o,this.renderMultiDrawInstances=l}function zx(i,t,e,n){let s;function r(){if(s!==void 0)return s;if(t.has("EXT_texture_filter_anisotropic")===!0){const y=t.get("EXT_texture_filter_anisotropic");s=i.getParameter(y.MAX_TEXTURE_MAX_ANISOTROPY_EXT)}else s=0;return s}function a(y){return!(y!==fi&&n.convert(y)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_FORMAT))}function o(y){const P=y===Pa&&(t.has("EXT_color_buffer_half_float")||t.has("EXT_color_buffer_float"));return!(y!==Vi&&n.convert(y)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_TYPE)&&y!==Bi&&!P)}function l(y){if(y==="highp"){if(i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.HIGH_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.HIGH_FLOAT).precision>0)return"highp";y="mediump"}return y==="mediump"&&i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.MEDIUM_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.MEDIUM_FLOAT).precision>0?"mediump":"lowp"}let c=e.precision!==void 0?e.precision:"highp";const u=l(c);u!==c&&(console.warn("THREE.WebGLRenderer:",c,"not supported, using",u,"instead."),c=u);const f=e.logarithmicDepthBuffer===!0,h=e.reverseDepthBuffer===!0&&t.has("EXT_clip_control");if(h===!0){const y=t.get("EXT_clip_control");y.clipControlEXT(y.LOWER_LEFT_EXT,y.ZERO_TO_ONE_EXT)}const _=i.getParameter(i.MAX_TEXTURE_IMAGE_UNITS),x=i.getParameter(i.MAX_VERTEX_TEXTURE_IMAGE_UNITS),M=i.getParameter(i.MAX_TEXTURE_SIZE),p=i.getParameter(i.MAX_CUBE_MAP_TEXTURE_SIZE),d=i.getParameter(i.MAX_VERTEX_ATTRIBS),C=i.getParameter(i.MAX_VERTEX_UNIFORM_VECTORS),b=i.getParameter(i.MAX_VARYING_VECTORS),R=i.getParameter(i.MAX_FRAGMENT_UNIFORM_VECTORS),D=x>0,A=i.getParameter(i.MAX_SAMPLES);return{isWebGL2:!0,getMaxAnisotropy:r,getMaxPrecision:l,textureFormatReadable:a,textureTypeReadable:o,precision:c,logarithmicDepthBuffer:f,reverseDepthBuffer:h,maxTextures:_,maxVertexTextures:x,maxTextureSize:M,maxCubemapSize:p,maxAttributes:d,maxVertexUniforms:C,maxVaryings:b,maxFragmentUniforms:R,vertexTextures:D,maxSamples:A}}function Hx(i){const t=this;let e=null,n=0,s=!1,r=!1;const a=new es,o=new oe,l={value:null,needsUpdate:!1};this.uniform=l,this.numPlanes=0,this.numIntersection=0,this.init=function(f,h){const _=f.length!==0||h||n!==0||s;return s=h,n=f.length,_},this.beginShadows=function(){r=!0,u(null)},this.endShadows=function(){r=!1},this.setGlobalState=function(f,h){e=u(f,h,0)},this.setState=function(f,h,_){const x=f.clippingPlanes,M=f.clipIntersection,p=f.clipShadows,d=i.get(f);if(!s||x===null||x.length===0||r&&!p)r?u(null):c();else{const C=r?0:n,b=C*4;let R=d.clippingState||null;l.value=R,R=u(x,h,b,_);for(let D=0;D!==b;++D)R[D]=e[D];d.clippingState=R,this.numIntersection=M?this.numPlanes:0,this.numPlanes+=C}};function c(){l.value!==e&&(l.value=e,l.needsUpdate=n>0),t.numPlanes=n,t.numIntersection=0}function u(f,h,_,x){const M=f!==null?f.length:0;let p=null;if(M!==0){if(p=l.value,x!==!0||p===null){const d=_+M*4,C=h.matrixWorldInverse;o.getNormalMatrix(C),(p===null||p.length<d)&&(p=new Float32Array(d));for(let b=0,R=_;b!==M;++b,R+=4)a.copy(f[b]).applyMatrix4(C,o),a.normal.toArray(p,R),p[R+3]=a.constant}l.value=p,l.needsUpdate=!0}return t.numPlanes=M,t.numIntersection=0,p}}function Gx(i){let t=new WeakMap;function e(a,o){return o===Nc?a.mapping=Nr:o===kc&&(a.mapping=kr),a}function n(a){if(a&&a.isTexture){const o=a.mapping;if(o===Nc||o===kc)if(t.has(a)){const l=t.get(a).texture;return e(l,a.mapping)}else{const l=a.image;if(l&&l.height>0){const c=new Q_(l.height);return c.fromEquirectangularTexture(i,a),t.set(a,c),a.addEventListener("dispose",s),e(c.texture,a.mapping)}else return null}}return a}function s(a){const o=a.target;o.removeEventListener("dispose",s);const l=t.get(o);l!==void 0&&(t.delete(o),l.dispose())}function r(){t=new WeakMap}return{get:n,dispose:r}}class Sp extends xp{constructor(t=-1,e=1,n=1,s=-1,r=.1,a=2e3){super(),this.isOrthographicCamera=!0,this.type="OrthographicCamera",this.zoom=1,this.view=null,this.left=t,this.right=e,this.top=n,this.bottom=s,this.near=r,this.far=a,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.left=t.left,this.right=t.right,this.top=t.top,this.bottom=t.bottom,this.near=t.near,this.far=t.far,this.zoom=t.zoom,this.view=t.view===null?null:Object.assign({},t.view),this}setViewOffset(t,e,n,s,r,a){this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=n,this.view.offsetY=s,this.view.width=r,this.view.height=a,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){const t=(this.right-this.left)/(2*this.zoom),e=(this.top-this.bottom)/(2*this.zoom),n=(this.right+this.left)/2,s=(this.top+this.bottom)/2;let r=n-t,a=n+t,o=s+e,l=s-e;if(this.view!==null&&this.view.enabled){const c=(this.right-this.left)/this.view.fullWidth/this.zoom,u=(this.top-this.bottom)/this.view.fullHeight/this.zoom;r+=c*this.view.offsetX,a=r+c*this.view.width,o-=u*this.view.offsetY,l=o-u*this.view.height}this.projectionMatrix.makeOrthographic(r,a,o,l,this.near,this.far,this.coordinateSystem),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){const e=super.toJSON(t);return e.object.zoom=this.zoom,e.object.left=this.left,e.object.right=this.right,e.object.top=this.top,e.object.bottom=this.bottom,e.object.near=this.near,e.object.far=this.far,this.view!==null&&(e.object.view=Object.assign({},this.view)),e}}const Tr=4,lf=[.125,.215,.35,.446,.526,.582],Cs=20,Jl=new Sp,cf=new ne;let Ql=null,tc=0,ec=0,nc=!1;const bs=(1+Math.sqrt(5))/2,gr=1/bs,hf=[new j(-bs,gr,0),new j(bs,gr,0),new j(-gr,0,bs),new j(gr,0,bs),new j(0,bs,-gr),new j(0,bs,gr),new j(-1,1,-1),new j(1,1,-1),new j(-1,1,1),new j(1,1,1)];class uf{constructor(t){this._renderer=t,this._pingPongRenderTarget=null,this._lodMax=0,this._cubeSize=0,this._lodPlanes=[],this._sizeLods=[],this._sigmas=[],this._blurMaterial=null,this._cubemapMaterial=null,this._equirectMaterial=null,this._compileMaterial(this._blurMaterial)}fromScene(t,e=0,n=.1,s=100){Ql=this._renderer.getRenderTarget(),tc=this._renderer.getActiveCubeFace(),ec=this._renderer.getActiveMipmapLevel(),nc=this._renderer.xr.enabled,this._renderer.xr.enabled=!1,this._setSize(256);const r=this._allocateTargets();return r.depthBuffer=!0,this._sceneToCubeUV(t,n,s,r),e>0&&this._blur(r,0,0,e),this._applyPMREM(r),this._cleanup(r),r}fromEquirectangular(t,e=null){return this._fromTexture(t,e)}fromCubemap(t,e=null){return this._fromTexture(t,e)}compileCubemapShader(){this._cubemapMaterial===null&&(this._cubemapMaterial=pf(),this._compileMaterial(this._cubemapMaterial))}compileEquirectangularShader(){this._equirectMaterial===null&&(this._equirectMaterial=df(),this._compileMaterial(this._equirectMaterial))}dispose(){this._dispose(),this._cubemapMaterial!==null&&this._cubemapMaterial.dispose(),this._equirectMaterial!==null&&this._equirectMaterial.dispose()}_setSize(t){this._lodMax=Math.floor(Math.log2(t)),this._cubeSize=Math.pow(2,this._lodMax)}_dispose(){this._blurMaterial!==null&&this._blurMaterial.dispose(),this._pingPongRenderTarget!==null&&this._pingPongRenderTarget.dispose();for(let t=0;t<this._lodPlanes.length;t++)this._lodPlanes[t].dispose()}_cleanup(t){this._renderer.setRenderTarget(Ql,tc,ec),this._renderer.xr.enabled=nc,t.scissorTest=!1,lo(t,0,0,t.width,t.height)}_fromTexture(t,e){t.mapping===Nr||t.mapping===kr?this._setSize(t.image.length===0?16:t.image[0].width||t.image[0].image.width):this._setSize(t.image.width/4),Ql=this._renderer.getRenderTarget(),tc=this._renderer.getActiveCubeFace(),ec=this._renderer.getActiveMipmapLevel(),nc=this._renderer.xr.enabled,this._renderer.xr.enabled=!1;const n=e||this._allocateTargets();return this._textureToCubeUV(t,n),this._applyPMREM(n),this._cleanup(n),n}_allocateTargets(){const t=3*Math.max(this._cubeSize,112),e=4*this._cubeSize,n={magFilter:ti,minFilter:ti,generateMipmaps:!1,type:Pa,format:fi,colorSpace:ps,depthBuffer:!1},s=ff(t,e,n);if(this._pingPongRenderTarget===null||this._pingPongRenderTarget.width!==t||this._pingPongRenderTarget.height!==e){this._pingPongRenderTarget!==null&&this._dispose(),this._pingPongRenderTarget=ff(t,e,n);const{_lodMax:r}=this;({sizeLods:this._sizeLods,lodPlanes:this._lodPlanes,sigmas:this._sigmas}=Vx(r)),this._blurMaterial=Wx(r,t,e)}return s}_compileMaterial(t){const e=new rn(this._lodPlanes[0],t);this._renderer.compile(e,Jl)}_sceneToCubeUV(t,e,n,s){const o=new Qn(90,1,e,n),l=[1,-1,1,1,1,1],c=[1,1,1,-1,-1,-1],u=this._renderer,f=u.autoClear,h=u.toneMapping;u.getClearColor(cf),u.toneMapping=ls,u.autoClear=!1;const _=new Xr({name:"PMREM.Background",side:On,depthWrite:!1,depthTest:!1}),x=new rn(new qr,_);let M=!1;const p=t.background;p?p.isColor&&(_.color.copy(p),t.background=null,M=!0):(_.color.copy(cf),M=!0);for(let d=0;d<6;d++){const C=d%3;C===0?(o.up.set(0,l[d],0),o.lookAt(c[d],0,0)):C===1?(o.up.set(0,0,l[d]),o.lookAt(0,c[d],0)):(o.up.set(0,l[d],0),o.lookAt(0,0,c[d]));const b=this._cubeSize;lo(s,C*b,d>2?b:0,b,b),u.setRenderTarget(s),M&&u.render(x,o),u.render(t,o)}x.geometry.dispose(),x.material.dispose(),u.toneMapping=h,u.autoClear=f,t.background=p}_textureToCubeUV(t,e){const n=this._renderer,s=t.mapping===Nr||t.mapping===kr;s?(this._cubemapMaterial===null&&(this._cubemapMaterial=pf()),this._cubemapMaterial.uniforms.flipEnvMap.value=t.isRenderTargetTexture===!1?-1:1):this._equirectMaterial===null&&(this._equirectMaterial=df());const r=s?this._cubemapMaterial:this._equirectMaterial,a=new rn(this._lodPlanes[0],r),o=r.uniforms;o.envMap.value=t;const l=this._cubeSize;lo(e,0,0,3*l,2*l),n.setRenderTarget(e),n.render(a,Jl)}_applyPMREM(t){const e=this._renderer,n=e.autoClear;e.autoClear=!1;const s=this._lodPlanes.length;for(let r=1;r<s;r++){const a=Math.sqrt(this._sigmas[r]*this._sigmas[r]-this._sigmas[r-1]*this._sigmas[r-1]),o=hf[(s-r-1)%hf.length];this._blur(t,r-1,r,a,o)}e.autoClear=n}_blur(t,e,n,s,r){const a=this._pingPongRenderTarget;this._halfBlur(t,a,e,n,s,"latitudinal",r),this._halfBlur(a,t,n,n,s,"longitudinal",r)}_halfBlur(t,e,n,s,r,a,o){const l=this._renderer,c=this._blurMaterial;a!=="latitudinal"&&a!=="longitudinal"&&console.error("blur direction must be either latitudinal or longitudinal!");const u=3,f=new rn(this._lodPlanes[s],c),h=c.uniforms,_=this._sizeLods[n]-1,x=isFinite(r)?Math.PI/(2*_):2*Math.PI/(2*Cs-1),M=r/x,p=isFinite(r)?1+Math.floor(u*M):Cs;p>Cs&&console.warn(`sigmaRadians, ${r}, is too large and will clip, as it requested ${p} samples when the maximum is set to ${Cs}`);const d=[];let C=0;for(let y=0;y<Cs;++y){const P=y/M,O=Math.exp(-P*P/2);d.push(O),y===0?C+=O:y<p&&(C+=2*O)}for(let y=0;y<d.length;y++)d[y]=d[y]/C;h.envMap.value=t.texture,h.samples.value=p,h.weights.value=d,h.latitudinal.value=a==="latitudinal",o&&(h.poleAxis.value=o);const{_lodMax:b}=this;h.dTheta.value=x,h.mipInt.value=b-n;const R=this._sizeLods[s],D=3*R*(s>b-Tr?s-b+Tr:0),A=4*(this._cubeSize-R);lo(e,D,A,3*R,2*R),l.setRenderTarget(e),l.render(f,Jl)}}function Vx(i){const t=[],e=[],n=[];let s=i;const r=i-Tr+1+lf.length;for(let a=0;a<r;a++){const o=Math.pow(2,s);e.push(o);let l=1/o;a>i-Tr?l=lf[a-i+Tr-1]:a===0&&(l=0),n.push(l);const c=1/(o-2),u=-c,f=1+c,h=[u,u,f,u,f,f,u,u,f,f,u,f],_=6,x=6,M=3,p=2,d=1,C=new Float32Array(M*x*_),b=new Float32Array(p*x*_),R=new Float32Array(d*x*_);for(let A=0;A<_;A++){const y=A%3*2/3-1,P=A>2?0:-1,O=[y,P,0,y+2/3,P,0,y+2/3,P+1,0,y,P,0,y+2/3,P+1,0,y,P+1,0];C.set(O,M*x*A),b.set(h,p*x*A);const g=[A,A,A,A,A,A];R.set(g,d*x*A)}const D=new gn;D.setAttribute("position",new Wn(C,M)),D.setAttribute("uv",new Wn(b,p)),D.setAttribute("faceIndex",new Wn(R,d)),t.push(D),s>Tr&&s--}return{lodPlanes:t,sizeLods:e,sigmas:n}}function ff(i,t,e){const n=new Fs(i,t,e);return n.texture.mapping=Qo,n.texture.name="PMREM.cubeUv",n.scissorTest=!0,n}function lo(i,t,e,n,s){i.viewport.set(t,e,n,s),i.scissor.set(t,e,n,s)}function Wx(i,t,e){const n=new Float32Array(Cs),s=new j(0,1,0);return new fs({name:"SphericalGaussianBlur",defines:{n:Cs,CUBEUV_TEXEL_WIDTH:1/t,CUBEUV_TEXEL_HEIGHT:1/e,CUBEUV_MAX_MIP:`${i}.0`},uniforms:{envMap:{value:null},samples:{value:1},weights:{value:n},latitudinal:{value:!1},dTheta:{value:0},mipInt:{value:0},poleAxis:{value:s}},vertexShader:zh(),fragmentShader:`

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
		`,blending:os,depthTest:!1,depthWrite:!1})}function df(){return new fs({name:"EquirectangularToCubeUV",uniforms:{envMap:{value:null}},vertexShader:zh(),fragmentShader:`

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
		`,blending:os,depthTest:!1,depthWrite:!1})}function pf(){return new fs({name:"CubemapToCubeUV",uniforms:{envMap:{value:null},flipEnvMap:{value:-1}},vertexShader:zh(),fragmentShader:`

			precision mediump float;
			precision mediump int;

			uniform float flipEnvMap;

			varying vec3 vOutputDirection;

			uniform samplerCube envMap;

			void main() {

				gl_FragColor = textureCube( envMap, vec3( flipEnvMap * vOutputDirection.x, vOutputDirection.yz ) );

			}
		`,blending:os,depthTest:!1,depthWrite:!1})}function zh(){return`

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
	`}function Xx(i){let t=new WeakMap,e=null;function n(o){if(o&&o.isTexture){const l=o.mapping,c=l===Nc||l===kc,u=l===Nr||l===kr;if(c||u){let f=t.get(o);const h=f!==void 0?f.texture.pmremVersion:0;if(o.isRenderTargetTexture&&o.pmremVersion!==h)return e===null&&(e=new uf(i)),f=c?e.fromEquirectangular(o,f):e.fromCubemap(o,f),f.texture.pmremVersion=o.pmremVersion,t.set(o,f),f.texture;if(f!==void 0)return f.texture;{const _=o.image;return c&&_&&_.height>0||u&&_&&s(_)?(e===null&&(e=new uf(i)),f=c?e.fromEquirectangular(o):e.fromCubemap(o),f.texture.pmremVersion=o.pmremVersion,t.set(o,f),o.addEventListener("dispose",r),f.texture):null}}}return o}function s(o){let l=0;const c=6;for(let u=0;u<c;u++)o[u]!==void 0&&l++;return l===c}function r(o){const l=o.target;l.removeEventListener("dispose",r);const c=t.get(l);c!==void 0&&(t.delete(l),c.dispose())}function a(){t=new WeakMap,e!==null&&(e.dispose(),e=null)}return{get:n,dispose:a}}function qx(i){const t={};function e(n){if(t[n]!==void 0)return t[n];let s;switch(n){case"WEBGL_depth_texture":s=i.getExtension("WEBGL_depth_texture")||i.getExtension("MOZ_WEBGL_depth_texture")||i.getExtension("WEBKIT_WEBGL_depth_texture");break;case"EXT_texture_filter_anisotropic":s=i.getExtension("EXT_texture_filter_anisotropic")||i.getExtension("MOZ_EXT_texture_filter_anisotropic")||i.getExtension("WEBKIT_EXT_texture_filter_anisotropic");break;case"WEBGL_compressed_texture_s3tc":s=i.getExtension("WEBGL_compressed_texture_s3tc")||i.getExtension("MOZ_WEBGL_compressed_texture_s3tc")||i.getExtension("WEBKIT_WEBGL_compressed_texture_s3tc");break;case"WEBGL_compressed_texture_pvrtc":s=i.getExtension("WEBGL_compressed_texture_pvrtc")||i.getExtension("WEBKIT_WEBGL_compressed_texture_pvrtc");break;default:s=i.getExtension(n)}return t[n]=s,s}return{has:function(n){return e(n)!==null},init:function(){e("EXT_color_buffer_float"),e("WEBGL_clip_cull_distance"),e("OES_texture_float_linear"),e("EXT_color_buffer_half_float"),e("WEBGL_multisampled_render_to_texture"),e("WEBGL_render_shared_exponent")},get:function(n){const s=e(n);return s===null&&Io("THREE.WebGLRenderer: "+n+" extension not supported."),s}}}function Yx(i,t,e,n){const s={},r=new WeakMap;function a(f){const h=f.target;h.index!==null&&t.remove(h.index);for(const x in h.attributes)t.remove(h.attributes[x]);for(const x in h.morphAttributes){const M=h.morphAttributes[x];for(let p=0,d=M.length;p<d;p++)t.remove(M[p])}h.removeEventListener("dispose",a),delete s[h.id];const _=r.get(h);_&&(t.remove(_),r.delete(h)),n.releaseStatesOfGeometry(h),h.isInstancedBufferGeometry===!0&&delete h._maxInstanceCount,e.memory.geometries--}function o(f,h){return s[h.id]===!0||(h.addEventListener("dispose",a),s[h.id]=!0,e.memory.geometries++),h}function l(f){const h=f.attributes;for(const x in h)t.update(h[x],i.ARRAY_BUFFER);const _=f.morphAttributes;for(const x in _){const M=_[x];for(let p=0,d=M.length;p<d;p++)t.update(M[p],i.ARRAY_BUFFER)}}function c(f){const h=[],_=f.index,x=f.attributes.position;let M=0;if(_!==null){const C=_.array;M=_.version;for(let b=0,R=C.length;b<R;b+=3){const D=C[b+0],A=C[b+1],y=C[b+2];h.push(D,A,A,y,y,D)}}else if(x!==void 0){const C=x.array;M=x.version;for(let b=0,R=C.length/3-1;b<R;b+=3){const D=b+0,A=b+1,y=b+2;h.push(D,A,A,y,y,D)}}else return;const p=new(up(h)?_p:gp)(h,1);p.version=M;const d=r.get(f);d&&t.remove(d),r.set(f,p)}function u(f){const h=r.get(f);if(h){const _=f.index;_!==null&&h.version<_.version&&c(f)}else c(f);return r.get(f)}return{get:o,update:l,getWireframeAttribute:u}}function jx(i,t,e){let n;function s(h){n=h}let r,a;function o(h){r=h.type,a=h.bytesPerElement}function l(h,_){i.drawElements(n,_,r,h*a),e.update(_,n,1)}function c(h,_,x){x!==0&&(i.drawElementsInstanced(n,_,r,h*a,x),e.update(_,n,x))}function u(h,_,x){if(x===0)return;t.get("WEBGL_multi_draw").multiDrawElementsWEBGL(n,_,0,r,h,0,x);let p=0;for(let d=0;d<x;d++)p+=_[d];e.update(p,n,1)}function f(h,_,x,M){if(x===0)return;const p=t.get("WEBGL_multi_draw");if(p===null)for(let d=0;d<h.length;d++)c(h[d]/a,_[d],M[d]);else{p.multiDrawElementsInstancedWEBGL(n,_,0,r,h,0,M,0,x);let d=0;for(let C=0;C<x;C++)d+=_[C];for(let C=0;C<M.length;C++)e.update(d,n,M[C])}}this.setMode=s,this.setIndex=o,this.render=l,this.renderInstances=c,this.renderMultiDraw=u,this.renderMultiDrawInstances=f}function Kx(i){const t={geometries:0,textures:0},e={frame:0,calls:0,triangles:0,points:0,lines:0};function n(r,a,o){switch(e.calls++,a){case i.TRIANGLES:e.triangles+=o*(r/3);break;case i.LINES:e.lines+=o*(r/2);break;case i.LINE_STRIP:e.lines+=o*(r-1);break;case i.LINE_LOOP:e.lines+=o*r;break;case i.POINTS:e.points+=o*r;break;default:console.error("THREE.WebGLInfo: Unknown draw mode:",a);break}}function s(){e.calls=0,e.triangles=0,e.points=0,e.lines=0}return{memory:t,render:e,programs:null,autoReset:!0,reset:s,update:n}}function $x(i,t,e){const n=new WeakMap,s=new je;function r(a,o,l){const c=a.morphTargetInfluences,u=o.morphAttributes.position||o.morphAttributes.normal||o.morphAttributes.color,f=u!==void 0?u.length:0;let h=n.get(o);if(h===void 0||h.count!==f){let g=function(){P.dispose(),n.delete(o),o.removeEventListener("dispose",g)};var _=g;h!==void 0&&h.texture.dispose();const x=o.morphAttributes.position!==void 0,M=o.morphAttributes.normal!==void 0,p=o.morphAttributes.color!==void 0,d=o.morphAttributes.position||[],C=o.morphAttributes.normal||[],b=o.morphAttributes.color||[];let R=0;x===!0&&(R=1),M===!0&&(R=2),p===!0&&(R=3);let D=o.attributes.position.count*R,A=1;D>t.maxTextureSize&&(A=Math.ceil(D/t.maxTextureSize),D=t.maxTextureSize);const y=new Float32Array(D*A*4*f),P=new dp(y,D,A,f);P.type=Bi,P.needsUpdate=!0;const O=R*4;for(let m=0;m<f;m++){const E=d[m],N=C[m],F=b[m],B=D*A*4*m;for(let G=0;G<E.count;G++){const $=G*O;x===!0&&(s.fromBufferAttribute(E,G),y[B+$+0]=s.x,y[B+$+1]=s.y,y[B+$+2]=s.z,y[B+$+3]=0),M===!0&&(s.fromBufferAttribute(N,G),y[B+$+4]=s.x,y[B+$+5]=s.y,y[B+$+6]=s.z,y[B+$+7]=0),p===!0&&(s.fromBufferAttribute(F,G),y[B+$+8]=s.x,y[B+$+9]=s.y,y[B+$+10]=s.z,y[B+$+11]=F.itemSize===4?s.w:1)}}h={count:f,texture:P,size:new Qt(D,A)},n.set(o,h),o.addEventListener("dispose",g)}if(a.isInstancedMesh===!0&&a.morphTexture!==null)l.getUniforms().setValue(i,"morphTexture",a.morphTexture,e);else{let x=0;for(let p=0;p<c.length;p++)x+=c[p];const M=o.morphTargetsRelative?1:1-x;l.getUniforms().setValue(i,"morphTargetBaseInfluence",M),l.getUniforms().setValue(i,"morphTargetInfluences",c)}l.getUniforms().setValue(i,"morphTargetsTexture",h.texture,e),l.getUniforms().setValue(i,"morphTargetsTextureSize",h.size)}return{update:r}}function Zx(i,t,e,n){let s=new WeakMap;function r(l){const c=n.render.frame,u=l.geometry,f=t.get(l,u);if(s.get(f)!==c&&(t.update(f),s.set(f,c)),l.isInstancedMesh&&(l.hasEventListener("dispose",o)===!1&&l.addEventListener("dispose",o),s.get(l)!==c&&(e.update(l.instanceMatrix,i.ARRAY_BUFFER),l.instanceColor!==null&&e.update(l.instanceColor,i.ARRAY_BUFFER),s.set(l,c))),l.isSkinnedMesh){const h=l.skeleton;s.get(h)!==c&&(h.update(),s.set(h,c))}return f}function a(){s=new WeakMap}function o(l){const c=l.target;c.removeEventListener("dispose",o),e.remove(c.instanceMatrix),c.instanceColor!==null&&e.remove(c.instanceColor)}return{update:r,dispose:a}}class Ep extends Ln{constructor(t,e,n,s,r,a,o,l,c,u=Lr){if(u!==Lr&&u!==Fr)throw new Error("DepthTexture format must be either THREE.DepthFormat or THREE.DepthStencilFormat");n===void 0&&u===Lr&&(n=Os),n===void 0&&u===Fr&&(n=Or),super(null,s,r,a,o,l,u,n,c),this.isDepthTexture=!0,this.image={width:t,height:e},this.magFilter=o!==void 0?o:ni,this.minFilter=l!==void 0?l:ni,this.flipY=!1,this.generateMipmaps=!1,this.compareFunction=null}copy(t){return super.copy(t),this.compareFunction=t.compareFunction,this}toJSON(t){const e=super.toJSON(t);return this.compareFunction!==null&&(e.compareFunction=this.compareFunction),e}}const wp=new Ln,mf=new Ep(1,1),bp=new dp,Tp=new O_,Ap=new Mp,gf=[],_f=[],vf=new Float32Array(16),xf=new Float32Array(9),Mf=new Float32Array(4);function Yr(i,t,e){const n=i[0];if(n<=0||n>0)return i;const s=t*e;let r=gf[s];if(r===void 0&&(r=new Float32Array(s),gf[s]=r),t!==0){n.toArray(r,0);for(let a=1,o=0;a!==t;++a)o+=e,i[a].toArray(r,o)}return r}function on(i,t){if(i.length!==t.length)return!1;for(let e=0,n=i.length;e<n;e++)if(i[e]!==t[e])return!1;return!0}function ln(i,t){for(let e=0,n=t.length;e<n;e++)i[e]=t[e]}function il(i,t){let e=_f[t];e===void 0&&(e=new Int32Array(t),_f[t]=e);for(let n=0;n!==t;++n)e[n]=i.allocateTextureUnit();return e}function Jx(i,t){const e=this.cache;e[0]!==t&&(i.uniform1f(this.addr,t),e[0]=t)}function Qx(i,t){const e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(i.uniform2f(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(on(e,t))return;i.uniform2fv(this.addr,t),ln(e,t)}}function tM(i,t){const e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(i.uniform3f(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else if(t.r!==void 0)(e[0]!==t.r||e[1]!==t.g||e[2]!==t.b)&&(i.uniform3f(this.addr,t.r,t.g,t.b),e[0]=t.r,e[1]=t.g,e[2]=t.b);else{if(on(e,t))return;i.uniform3fv(this.addr,t),ln(e,t)}}function eM(i,t){const e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(i.uniform4f(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(on(e,t))return;i.uniform4fv(this.addr,t),ln(e,t)}}function nM(i,t){const e=this.cache,n=t.elements;if(n===void 0){if(on(e,t))return;i.uniformMatrix2fv(this.addr,!1,t),ln(e,t)}else{if(on(e,n))return;Mf.set(n),i.uniformMatrix2fv(this.addr,!1,Mf),ln(e,n)}}function iM(i,t){const e=this.cache,n=t.elements;if(n===void 0){if(on(e,t))return;i.uniformMatrix3fv(this.addr,!1,t),ln(e,t)}else{if(on(e,n))return;xf.set(n),i.uniformMatrix3fv(this.addr,!1,xf),ln(e,n)}}function sM(i,t){const e=this.cache,n=t.elements;if(n===void 0){if(on(e,t))return;i.uniformMatrix4fv(this.addr,!1,t),ln(e,t)}else{if(on(e,n))return;vf.set(n),i.uniformMatrix4fv(this.addr,!1,vf),ln(e,n)}}function rM(i,t){const e=this.cache;e[0]!==t&&(i.uniform1i(this.addr,t),e[0]=t)}function aM(i,t){const e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(i.uniform2i(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(on(e,t))return;i.uniform2iv(this.addr,t),ln(e,t)}}function oM(i,t){const e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(i.uniform3i(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(on(e,t))return;i.uniform3iv(this.addr,t),ln(e,t)}}function lM(i,t){const e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(i.uniform4i(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(on(e,t))return;i.uniform4iv(this.addr,t),ln(e,t)}}function cM(i,t){const e=this.cache;e[0]!==t&&(i.uniform1ui(this.addr,t),e[0]=t)}function hM(i,t){const e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(i.uniform2ui(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(on(e,t))return;i.uniform2uiv(this.addr,t),ln(e,t)}}function uM(i,t){const e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(i.uniform3ui(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(on(e,t))return;i.uniform3uiv(this.addr,t),ln(e,t)}}function fM(i,t){const e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(i.uniform4ui(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(on(e,t))return;i.uniform4uiv(this.addr,t),ln(e,t)}}function dM(i,t,e){const n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s);let r;this.type===i.SAMPLER_2D_SHADOW?(mf.compareFunction=hp,r=mf):r=wp,e.setTexture2D(t||r,s)}function pM(i,t,e){const n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),e.setTexture3D(t||Tp,s)}function mM(i,t,e){const n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),e.setTextureCube(t||Ap,s)}function gM(i,t,e){const n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),e.setTexture2DArray(t||bp,s)}function _M(i){switch(i){case 5126:return Jx;case 35664:return Qx;case 35665:return tM;case 35666:return eM;case 35674:return nM;case 35675:return iM;case 35676:return sM;case 5124:case 35670:return rM;case 35667:case 35671:return aM;case 35668:case 35672:return oM;case 35669:case 35673:return lM;case 5125:return cM;case 36294:return hM;case 36295:return uM;case 36296:return fM;case 35678:case 36198:case 36298:case 36306:case 35682:return dM;case 35679:case 36299:case 36307:return pM;case 35680:case 36300:case 36308:case 36293:return mM;case 36289:case 36303:case 36311:case 36292:return gM}}function vM(i,t){i.uniform1fv(this.addr,t)}function xM(i,t){const e=Yr(t,this.size,2);i.uniform2fv(this.addr,e)}function MM(i,t){const e=Yr(t,this.size,3);i.uniform3fv(this.addr,e)}function yM(i,t){const e=Yr(t,this.size,4);i.uniform4fv(this.addr,e)}function SM(i,t){const e=Yr(t,this.size,4);i.uniformMatrix2fv(this.addr,!1,e)}function EM(i,t){const e=Yr(t,this.size,9);i.uniformMatrix3fv(this.addr,!1,e)}function wM(i,t){const e=Yr(t,this.size,16);i.uniformMatrix4fv(this.addr,!1,e)}function bM(i,t){i.uniform1iv(this.addr,t)}function TM(i,t){i.uniform2iv(this.addr,t)}function AM(i,t){i.uniform3iv(this.addr,t)}function RM(i,t){i.uniform4iv(this.addr,t)}function CM(i,t){i.uniform1uiv(this.addr,t)}function PM(i,t){i.uniform2uiv(this.addr,t)}function LM(i,t){i.uniform3uiv(this.addr,t)}function DM(i,t){i.uniform4uiv(this.addr,t)}function IM(i,t,e){const n=this.cache,s=t.length,r=il(e,s);on(n,r)||(i.uniform1iv(this.addr,r),ln(n,r));for(let a=0;a!==s;++a)e.setTexture2D(t[a]||wp,r[a])}function UM(i,t,e){const n=this.cache,s=t.length,r=il(e,s);on(n,r)||(i.uniform1iv(this.addr,r),ln(n,r));for(let a=0;a!==s;++a)e.setTexture3D(t[a]||Tp,r[a])}function NM(i,t,e){const n=this.cache,s=t.length,r=il(e,s);on(n,r)||(i.uniform1iv(this.addr,r),ln(n,r));for(let a=0;a!==s;++a)e.setTextureCube(t[a]||Ap,r[a])}function kM(i,t,e){const n=this.cache,s=t.length,r=il(e,s);on(n,r)||(i.uniform1iv(this.addr,r),ln(n,r));for(let a=0;a!==s;++a)e.setTexture2DArray(t[a]||bp,r[a])}function OM(i){switch(i){case 5126:return vM;case 35664:return xM;case 35665:return MM;case 35666:return yM;case 35674:return SM;case 35675:return EM;case 35676:return wM;case 5124:case 35670:return bM;case 35667:case 35671:return TM;case 35668:case 35672:return AM;case 35669:case 35673:return RM;case 5125:return CM;case 36294:return PM;case 36295:return LM;case 36296:return DM;case 35678:case 36198:case 36298:case 36306:case 35682:return IM;case 35679:case 36299:case 36307:return UM;case 35680:case 36300:case 36308:case 36293:return NM;case 36289:case 36303:case 36311:case 36292:return kM}}class FM{constructor(t,e,n){this.id=t,this.addr=n,this.cache=[],this.type=e.type,this.setValue=_M(e.type)}}class BM{constructor(t,e,n){this.id=t,this.addr=n,this.cache=[],this.type=e.type,this.size=e.size,this.setValue=OM(e.type)}}class zM{constructor(t){this.id=t,this.seq=[],this.map={}}setValue(t,e,n){const s=this.seq;for(let r=0,a=s.length;r!==a;++r){const o=s[r];o.setValue(t,e[o.id],n)}}}const ic=/(\w+)(\])?(\[|\.)?/g;function yf(i,t){i.seq.push(t),i.map[t.id]=t}function HM(i,t,e){const n=i.name,s=n.length;for(ic.lastIndex=0;;){const r=ic.exec(n),a=ic.lastIndex;let o=r[1];const l=r[2]==="]",c=r[3];if(l&&(o=o|0),c===void 0||c==="["&&a+2===s){yf(e,c===void 0?new FM(o,i,t):new BM(o,i,t));break}else{let f=e.map[o];f===void 0&&(f=new zM(o),yf(e,f)),e=f}}}class Uo{constructor(t,e){this.seq=[],this.map={};const n=t.getProgramParameter(e,t.ACTIVE_UNIFORMS);for(let s=0;s<n;++s){const r=t.getActiveUniform(e,s),a=t.getUniformLocation(e,r.name);HM(r,a,this)}}setValue(t,e,n,s){const r=this.map[e];r!==void 0&&r.setValue(t,n,s)}setOptional(t,e,n){const s=e[n];s!==void 0&&this.setValue(t,n,s)}static upload(t,e,n,s){for(let r=0,a=e.length;r!==a;++r){const o=e[r],l=n[o.id];l.needsUpdate!==!1&&o.setValue(t,l.value,s)}}static seqWithValue(t,e){const n=[];for(let s=0,r=t.length;s!==r;++s){const a=t[s];a.id in e&&n.push(a)}return n}}function Sf(i,t,e){const n=i.createShader(t);return i.shaderSource(n,e),i.compileShader(n),n}const GM=37297;let VM=0;function WM(i,t){const e=i.split(`
`),n=[],s=Math.max(t-6,0),r=Math.min(t+6,e.length);for(let a=s;a<r;a++){const o=a+1;n.push(`${o===t?">":" "} ${o}: ${e[a]}`)}return n.join(`
`)}function XM(i){const t=ye.getPrimaries(ye.workingColorSpace),e=ye.getPrimaries(i);let n;switch(t===e?n="":t===Go&&e===Ho?n="LinearDisplayP3ToLinearSRGB":t===Ho&&e===Go&&(n="LinearSRGBToLinearDisplayP3"),i){case ps:case tl:return[n,"LinearTransferOETF"];case yi:case Oh:return[n,"sRGBTransferOETF"];default:return console.warn("THREE.WebGLProgram: Unsupported color space:",i),[n,"LinearTransferOETF"]}}function Ef(i,t,e){const n=i.getShaderParameter(t,i.COMPILE_STATUS),s=i.getShaderInfoLog(t).trim();if(n&&s==="")return"";const r=/ERROR: 0:(\d+)/.exec(s);if(r){const a=parseInt(r[1]);return e.toUpperCase()+`

`+s+`

`+WM(i.getShaderSource(t),a)}else return s}function qM(i,t){const e=XM(t);return`vec4 ${i}( vec4 value ) { return ${e[0]}( ${e[1]}( value ) ); }`}function YM(i,t){let e;switch(t){case l_:e="Linear";break;case c_:e="Reinhard";break;case h_:e="Cineon";break;case u_:e="ACESFilmic";break;case d_:e="AgX";break;case p_:e="Neutral";break;case f_:e="Custom";break;default:console.warn("THREE.WebGLProgram: Unsupported toneMapping:",t),e="Linear"}return"vec3 "+i+"( vec3 color ) { return "+e+"ToneMapping( color ); }"}const co=new j;function jM(){ye.getLuminanceCoefficients(co);const i=co.x.toFixed(4),t=co.y.toFixed(4),e=co.z.toFixed(4);return["float luminance( const in vec3 rgb ) {",`	const vec3 weights = vec3( ${i}, ${t}, ${e} );`,"	return dot( weights, rgb );","}"].join(`
`)}function KM(i){return[i.extensionClipCullDistance?"#extension GL_ANGLE_clip_cull_distance : require":"",i.extensionMultiDraw?"#extension GL_ANGLE_multi_draw : require":""].filter(va).join(`
`)}function $M(i){const t=[];for(const e in i){const n=i[e];n!==!1&&t.push("#define "+e+" "+n)}return t.join(`
`)}function ZM(i,t){const e={},n=i.getProgramParameter(t,i.ACTIVE_ATTRIBUTES);for(let s=0;s<n;s++){const r=i.getActiveAttrib(t,s),a=r.name;let o=1;r.type===i.FLOAT_MAT2&&(o=2),r.type===i.FLOAT_MAT3&&(o=3),r.type===i.FLOAT_MAT4&&(o=4),e[a]={type:r.type,location:i.getAttribLocation(t,a),locationSize:o}}return e}function va(i){return i!==""}function wf(i,t){const e=t.numSpotLightShadows+t.numSpotLightMaps-t.numSpotLightShadowsWithMaps;return i.replace(/NUM_DIR_LIGHTS/g,t.numDirLights).replace(/NUM_SPOT_LIGHTS/g,t.numSpotLights).replace(/NUM_SPOT_LIGHT_MAPS/g,t.numSpotLightMaps).replace(/NUM_SPOT_LIGHT_COORDS/g,e).replace(/NUM_RECT_AREA_LIGHTS/g,t.numRectAreaLights).replace(/NUM_POINT_LIGHTS/g,t.numPointLights).replace(/NUM_HEMI_LIGHTS/g,t.numHemiLights).replace(/NUM_DIR_LIGHT_SHADOWS/g,t.numDirLightShadows).replace(/NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS/g,t.numSpotLightShadowsWithMaps).replace(/NUM_SPOT_LIGHT_SHADOWS/g,t.numSpotLightShadows).replace(/NUM_POINT_LIGHT_SHADOWS/g,t.numPointLightShadows)}function bf(i,t){return i.replace(/NUM_CLIPPING_PLANES/g,t.numClippingPlanes).replace(/UNION_CLIPPING_PLANES/g,t.numClippingPlanes-t.numClipIntersection)}const JM=/^[ \t]*#include +<([\w\d./]+)>/gm;function dh(i){return i.replace(JM,ty)}const QM=new Map;function ty(i,t){let e=ae[t];if(e===void 0){const n=QM.get(t);if(n!==void 0)e=ae[n],console.warn('THREE.WebGLRenderer: Shader chunk "%s" has been deprecated. Use "%s" instead.',t,n);else throw new Error("Can not resolve #include <"+t+">")}return dh(e)}const ey=/#pragma unroll_loop_start\s+for\s*\(\s*int\s+i\s*=\s*(\d+)\s*;\s*i\s*<\s*(\d+)\s*;\s*i\s*\+\+\s*\)\s*{([\s\S]+?)}\s+#pragma unroll_loop_end/g;function Tf(i){return i.replace(ey,ny)}function ny(i,t,e,n){let s="";for(let r=parseInt(t);r<parseInt(e);r++)s+=n.replace(/\[\s*i\s*\]/g,"[ "+r+" ]").replace(/UNROLLED_LOOP_INDEX/g,r);return s}function Af(i){let t=`precision ${i.precision} float;
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
#define LOW_PRECISION`),t}function iy(i){let t="SHADOWMAP_TYPE_BASIC";return i.shadowMapType===Zd?t="SHADOWMAP_TYPE_PCF":i.shadowMapType===Hg?t="SHADOWMAP_TYPE_PCF_SOFT":i.shadowMapType===Oi&&(t="SHADOWMAP_TYPE_VSM"),t}function sy(i){let t="ENVMAP_TYPE_CUBE";if(i.envMap)switch(i.envMapMode){case Nr:case kr:t="ENVMAP_TYPE_CUBE";break;case Qo:t="ENVMAP_TYPE_CUBE_UV";break}return t}function ry(i){let t="ENVMAP_MODE_REFLECTION";if(i.envMap)switch(i.envMapMode){case kr:t="ENVMAP_MODE_REFRACTION";break}return t}function ay(i){let t="ENVMAP_BLENDING_NONE";if(i.envMap)switch(i.combine){case Ph:t="ENVMAP_BLENDING_MULTIPLY";break;case a_:t="ENVMAP_BLENDING_MIX";break;case o_:t="ENVMAP_BLENDING_ADD";break}return t}function oy(i){const t=i.envMapCubeUVHeight;if(t===null)return null;const e=Math.log2(t)-2,n=1/t;return{texelWidth:1/(3*Math.max(Math.pow(2,e),7*16)),texelHeight:n,maxMip:e}}function ly(i,t,e,n){const s=i.getContext(),r=e.defines;let a=e.vertexShader,o=e.fragmentShader;const l=iy(e),c=sy(e),u=ry(e),f=ay(e),h=oy(e),_=KM(e),x=$M(r),M=s.createProgram();let p,d,C=e.glslVersion?"#version "+e.glslVersion+`
`:"";e.isRawShaderMaterial?(p=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,x].filter(va).join(`
`),p.length>0&&(p+=`
`),d=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,x].filter(va).join(`
`),d.length>0&&(d+=`
`)):(p=[Af(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,x,e.extensionClipCullDistance?"#define USE_CLIP_DISTANCE":"",e.batching?"#define USE_BATCHING":"",e.batchingColor?"#define USE_BATCHING_COLOR":"",e.instancing?"#define USE_INSTANCING":"",e.instancingColor?"#define USE_INSTANCING_COLOR":"",e.instancingMorph?"#define USE_INSTANCING_MORPH":"",e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.map?"#define USE_MAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+u:"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.displacementMap?"#define USE_DISPLACEMENTMAP":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.mapUv?"#define MAP_UV "+e.mapUv:"",e.alphaMapUv?"#define ALPHAMAP_UV "+e.alphaMapUv:"",e.lightMapUv?"#define LIGHTMAP_UV "+e.lightMapUv:"",e.aoMapUv?"#define AOMAP_UV "+e.aoMapUv:"",e.emissiveMapUv?"#define EMISSIVEMAP_UV "+e.emissiveMapUv:"",e.bumpMapUv?"#define BUMPMAP_UV "+e.bumpMapUv:"",e.normalMapUv?"#define NORMALMAP_UV "+e.normalMapUv:"",e.displacementMapUv?"#define DISPLACEMENTMAP_UV "+e.displacementMapUv:"",e.metalnessMapUv?"#define METALNESSMAP_UV "+e.metalnessMapUv:"",e.roughnessMapUv?"#define ROUGHNESSMAP_UV "+e.roughnessMapUv:"",e.anisotropyMapUv?"#define ANISOTROPYMAP_UV "+e.anisotropyMapUv:"",e.clearcoatMapUv?"#define CLEARCOATMAP_UV "+e.clearcoatMapUv:"",e.clearcoatNormalMapUv?"#define CLEARCOAT_NORMALMAP_UV "+e.clearcoatNormalMapUv:"",e.clearcoatRoughnessMapUv?"#define CLEARCOAT_ROUGHNESSMAP_UV "+e.clearcoatRoughnessMapUv:"",e.iridescenceMapUv?"#define IRIDESCENCEMAP_UV "+e.iridescenceMapUv:"",e.iridescenceThicknessMapUv?"#define IRIDESCENCE_THICKNESSMAP_UV "+e.iridescenceThicknessMapUv:"",e.sheenColorMapUv?"#define SHEEN_COLORMAP_UV "+e.sheenColorMapUv:"",e.sheenRoughnessMapUv?"#define SHEEN_ROUGHNESSMAP_UV "+e.sheenRoughnessMapUv:"",e.specularMapUv?"#define SPECULARMAP_UV "+e.specularMapUv:"",e.specularColorMapUv?"#define SPECULAR_COLORMAP_UV "+e.specularColorMapUv:"",e.specularIntensityMapUv?"#define SPECULAR_INTENSITYMAP_UV "+e.specularIntensityMapUv:"",e.transmissionMapUv?"#define TRANSMISSIONMAP_UV "+e.transmissionMapUv:"",e.thicknessMapUv?"#define THICKNESSMAP_UV "+e.thicknessMapUv:"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexColors?"#define USE_COLOR":"",e.vertexAlphas?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.flatShading?"#define FLAT_SHADED":"",e.skinning?"#define USE_SKINNING":"",e.morphTargets?"#define USE_MORPHTARGETS":"",e.morphNormals&&e.flatShading===!1?"#define USE_MORPHNORMALS":"",e.morphColors?"#define USE_MORPHCOLORS":"",e.morphTargetsCount>0?"#define MORPHTARGETS_TEXTURE_STRIDE "+e.morphTextureStride:"",e.morphTargetsCount>0?"#define MORPHTARGETS_COUNT "+e.morphTargetsCount:"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+l:"",e.sizeAttenuation?"#define USE_SIZEATTENUATION":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.logarithmicDepthBuffer?"#define USE_LOGDEPTHBUF":"",e.reverseDepthBuffer?"#define USE_REVERSEDEPTHBUF":"","uniform mat4 modelMatrix;","uniform mat4 modelViewMatrix;","uniform mat4 projectionMatrix;","uniform mat4 viewMatrix;","uniform mat3 normalMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;","#ifdef USE_INSTANCING","	attribute mat4 instanceMatrix;","#endif","#ifdef USE_INSTANCING_COLOR","	attribute vec3 instanceColor;","#endif","#ifdef USE_INSTANCING_MORPH","	uniform sampler2D morphTexture;","#endif","attribute vec3 position;","attribute vec3 normal;","attribute vec2 uv;","#ifdef USE_UV1","	attribute vec2 uv1;","#endif","#ifdef USE_UV2","	attribute vec2 uv2;","#endif","#ifdef USE_UV3","	attribute vec2 uv3;","#endif","#ifdef USE_TANGENT","	attribute vec4 tangent;","#endif","#if defined( USE_COLOR_ALPHA )","	attribute vec4 color;","#elif defined( USE_COLOR )","	attribute vec3 color;","#endif","#ifdef USE_SKINNING","	attribute vec4 skinIndex;","	attribute vec4 skinWeight;","#endif",`
`].filter(va).join(`
`),d=[Af(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,x,e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.alphaToCoverage?"#define ALPHA_TO_COVERAGE":"",e.map?"#define USE_MAP":"",e.matcap?"#define USE_MATCAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+c:"",e.envMap?"#define "+u:"",e.envMap?"#define "+f:"",h?"#define CUBEUV_TEXEL_WIDTH "+h.texelWidth:"",h?"#define CUBEUV_TEXEL_HEIGHT "+h.texelHeight:"",h?"#define CUBEUV_MAX_MIP "+h.maxMip+".0":"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoat?"#define USE_CLEARCOAT":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.dispersion?"#define USE_DISPERSION":"",e.iridescence?"#define USE_IRIDESCENCE":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaTest?"#define USE_ALPHATEST":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.sheen?"#define USE_SHEEN":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexColors||e.instancingColor||e.batchingColor?"#define USE_COLOR":"",e.vertexAlphas?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.gradientMap?"#define USE_GRADIENTMAP":"",e.flatShading?"#define FLAT_SHADED":"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+l:"",e.premultipliedAlpha?"#define PREMULTIPLIED_ALPHA":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.decodeVideoTexture?"#define DECODE_VIDEO_TEXTURE":"",e.logarithmicDepthBuffer?"#define USE_LOGDEPTHBUF":"",e.reverseDepthBuffer?"#define USE_REVERSEDEPTHBUF":"","uniform mat4 viewMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;",e.toneMapping!==ls?"#define TONE_MAPPING":"",e.toneMapping!==ls?ae.tonemapping_pars_fragment:"",e.toneMapping!==ls?YM("toneMapping",e.toneMapping):"",e.dithering?"#define DITHERING":"",e.opaque?"#define OPAQUE":"",ae.colorspace_pars_fragment,qM("linearToOutputTexel",e.outputColorSpace),jM(),e.useDepthPacking?"#define DEPTH_PACKING "+e.depthPacking:"",`
`].filter(va).join(`
`)),a=dh(a),a=wf(a,e),a=bf(a,e),o=dh(o),o=wf(o,e),o=bf(o,e),a=Tf(a),o=Tf(o),e.isRawShaderMaterial!==!0&&(C=`#version 300 es
`,p=[_,"#define attribute in","#define varying out","#define texture2D texture"].join(`
`)+`
`+p,d=["#define varying in",e.glslVersion===Vu?"":"layout(location = 0) out highp vec4 pc_fragColor;",e.glslVersion===Vu?"":"#define gl_FragColor pc_fragColor","#define gl_FragDepthEXT gl_FragDepth","#define texture2D texture","#define textureCube texture","#define texture2DProj textureProj","#define texture2DLodEXT textureLod","#define texture2DProjLodEXT textureProjLod","#define textureCubeLodEXT textureLod","#define texture2DGradEXT textureGrad","#define texture2DProjGradEXT textureProjGrad","#define textureCubeGradEXT textureGrad"].join(`
`)+`
`+d);const b=C+p+a,R=C+d+o,D=Sf(s,s.VERTEX_SHADER,b),A=Sf(s,s.FRAGMENT_SHADER,R);s.attachShader(M,D),s.attachShader(M,A),e.index0AttributeName!==void 0?s.bindAttribLocation(M,0,e.index0AttributeName):e.morphTargets===!0&&s.bindAttribLocation(M,0,"position"),s.linkProgram(M);function y(m){if(i.debug.checkShaderErrors){const E=s.getProgramInfoLog(M).trim(),N=s.getShaderInfoLog(D).trim(),F=s.getShaderInfoLog(A).trim();let B=!0,G=!0;if(s.getProgramParameter(M,s.LINK_STATUS)===!1)if(B=!1,typeof i.debug.onShaderError=="function")i.debug.onShaderError(s,M,D,A);else{const $=Ef(s,D,"vertex"),Q=Ef(s,A,"fragment");console.error("THREE.WebGLProgram: Shader Error "+s.getError()+" - VALIDATE_STATUS "+s.getProgramParameter(M,s.VALIDATE_STATUS)+`

Material Name: `+m.name+`
Material Type: `+m.type+`

Program Info Log: `+E+`
`+$+`
`+Q)}else E!==""?console.warn("THREE.WebGLProgram: Program Info Log:",E):(N===""||F==="")&&(G=!1);G&&(m.diagnostics={runnable:B,programLog:E,vertexShader:{log:N,prefix:p},fragmentShader:{log:F,prefix:d}})}s.deleteShader(D),s.deleteShader(A),P=new Uo(s,M),O=ZM(s,M)}let P;this.getUniforms=function(){return P===void 0&&y(this),P};let O;this.getAttributes=function(){return O===void 0&&y(this),O};let g=e.rendererExtensionParallelShaderCompile===!1;return this.isReady=function(){return g===!1&&(g=s.getProgramParameter(M,GM)),g},this.destroy=function(){n.releaseStatesOfProgram(this),s.deleteProgram(M),this.program=void 0},this.type=e.shaderType,this.name=e.shaderName,this.id=VM++,this.cacheKey=t,this.usedTimes=1,this.program=M,this.vertexShader=D,this.fragmentShader=A,this}let cy=0;class hy{constructor(){this.shaderCache=new Map,this.materialCache=new Map}update(t){const e=t.vertexShader,n=t.fragmentShader,s=this._getShaderStage(e),r=this._getShaderStage(n),a=this._getShaderCacheForMaterial(t);return a.has(s)===!1&&(a.add(s),s.usedTimes++),a.has(r)===!1&&(a.add(r),r.usedTimes++),this}remove(t){const e=this.materialCache.get(t);for(const n of e)n.usedTimes--,n.usedTimes===0&&this.shaderCache.delete(n.code);return this.materialCache.delete(t),this}getVertexShaderID(t){return this._getShaderStage(t.vertexShader).id}getFragmentShaderID(t){return this._getShaderStage(t.fragmentShader).id}dispose(){this.shaderCache.clear(),this.materialCache.clear()}_getShaderCacheForMaterial(t){const e=this.materialCache;let n=e.get(t);return n===void 0&&(n=new Set,e.set(t,n)),n}_getShaderStage(t){const e=this.shaderCache;let n=e.get(t);return n===void 0&&(n=new uy(t),e.set(t,n)),n}}class uy{constructor(t){this.id=cy++,this.code=t,this.usedTimes=0}}function fy(i,t,e,n,s,r,a){const o=new pp,l=new hy,c=new Set,u=[],f=s.logarithmicDepthBuffer,h=s.reverseDepthBuffer,_=s.vertexTextures;let x=s.precision;const M={MeshDepthMaterial:"depth",MeshDistanceMaterial:"distanceRGBA",MeshNormalMaterial:"normal",MeshBasicMaterial:"basic",MeshLambertMaterial:"lambert",MeshPhongMaterial:"phong",MeshToonMaterial:"toon",MeshStandardMaterial:"physical",MeshPhysicalMaterial:"physical",MeshMatcapMaterial:"matcap",LineBasicMaterial:"basic",LineDashedMaterial:"dashed",PointsMaterial:"points",ShadowMaterial:"shadow",SpriteMaterial:"sprite"};function p(g){return c.add(g),g===0?"uv":`uv${g}`}function d(g,m,E,N,F){const B=N.fog,G=F.geometry,$=g.isMeshStandardMaterial?N.environment:null,Q=(g.isMeshStandardMaterial?e:t).get(g.envMap||$),dt=Q&&Q.mapping===Qo?Q.image.height:null,ct=M[g.type];g.precision!==null&&(x=s.getMaxPrecision(g.precision),x!==g.precision&&console.warn("THREE.WebGLProgram.getParameters:",g.precision,"not supported, using",x,"instead."));const gt=G.morphAttributes.position||G.morphAttributes.normal||G.morphAttributes.color,xt=gt!==void 0?gt.length:0;let Vt=0;G.morphAttributes.position!==void 0&&(Vt=1),G.morphAttributes.normal!==void 0&&(Vt=2),G.morphAttributes.color!==void 0&&(Vt=3);let rt,pt,Dt,St;if(ct){const Xe=Si[ct];rt=Xe.vertexShader,pt=Xe.fragmentShader}else rt=g.vertexShader,pt=g.fragmentShader,l.update(g),Dt=l.getVertexShaderID(g),St=l.getFragmentShaderID(g);const Z=i.getRenderTarget(),J=F.isInstancedMesh===!0,Y=F.isBatchedMesh===!0,at=!!g.map,ot=!!g.matcap,I=!!Q,Ot=!!g.aoMap,Mt=!!g.lightMap,Ht=!!g.bumpMap,At=!!g.normalMap,Et=!!g.displacementMap,Xt=!!g.emissiveMap,L=!!g.metalnessMap,w=!!g.roughnessMap,V=g.anisotropy>0,it=g.clearcoat>0,ht=g.dispersion>0,nt=g.iridescence>0,It=g.sheen>0,wt=g.transmission>0,Ut=V&&!!g.anisotropyMap,re=it&&!!g.clearcoatMap,mt=it&&!!g.clearcoatNormalMap,Rt=it&&!!g.clearcoatRoughnessMap,jt=nt&&!!g.iridescenceMap,$t=nt&&!!g.iridescenceThicknessMap,Lt=It&&!!g.sheenColorMap,ie=It&&!!g.sheenRoughnessMap,te=!!g.specularMap,pe=!!g.specularColorMap,q=!!g.specularIntensityMap,Tt=wt&&!!g.transmissionMap,lt=wt&&!!g.thicknessMap,ft=!!g.gradientMap,Nt=!!g.alphaMap,Bt=g.alphaTest>0,fe=!!g.alphaHash,We=!!g.extensions;let _n=ls;g.toneMapped&&(Z===null||Z.isXRRenderTarget===!0)&&(_n=i.toneMapping);const bt={shaderID:ct,shaderType:g.type,shaderName:g.name,vertexShader:rt,fragmentShader:pt,defines:g.defines,customVertexShaderID:Dt,customFragmentShaderID:St,isRawShaderMaterial:g.isRawShaderMaterial===!0,glslVersion:g.glslVersion,precision:x,batching:Y,batchingColor:Y&&F._colorsTexture!==null,instancing:J,instancingColor:J&&F.instanceColor!==null,instancingMorph:J&&F.morphTexture!==null,supportsVertexTextures:_,outputColorSpace:Z===null?i.outputColorSpace:Z.isXRRenderTarget===!0?Z.texture.colorSpace:ps,alphaToCoverage:!!g.alphaToCoverage,map:at,matcap:ot,envMap:I,envMapMode:I&&Q.mapping,envMapCubeUVHeight:dt,aoMap:Ot,lightMap:Mt,bumpMap:Ht,normalMap:At,displacementMap:_&&Et,emissiveMap:Xt,normalMapObjectSpace:At&&g.normalMapType===v_,normalMapTangentSpace:At&&g.normalMapType===cp,metalnessMap:L,roughnessMap:w,anisotropy:V,anisotropyMap:Ut,clearcoat:it,clearcoatMap:re,clearcoatNormalMap:mt,clearcoatRoughnessMap:Rt,dispersion:ht,iridescence:nt,iridescenceMap:jt,iridescenceThicknessMap:$t,sheen:It,sheenColorMap:Lt,sheenRoughnessMap:ie,specularMap:te,specularColorMap:pe,specularIntensityMap:q,transmission:wt,transmissionMap:Tt,thicknessMap:lt,gradientMap:ft,opaque:g.transparent===!1&&g.blending===Pr&&g.alphaToCoverage===!1,alphaMap:Nt,alphaTest:Bt,alphaHash:fe,combine:g.combine,mapUv:at&&p(g.map.channel),aoMapUv:Ot&&p(g.aoMap.channel),lightMapUv:Mt&&p(g.lightMap.channel),bumpMapUv:Ht&&p(g.bumpMap.channel),normalMapUv:At&&p(g.normalMap.channel),displacementMapUv:Et&&p(g.displacementMap.channel),emissiveMapUv:Xt&&p(g.emissiveMap.channel),metalnessMapUv:L&&p(g.metalnessMap.channel),roughnessMapUv:w&&p(g.roughnessMap.channel),anisotropyMapUv:Ut&&p(g.anisotropyMap.channel),clearcoatMapUv:re&&p(g.clearcoatMap.channel),clearcoatNormalMapUv:mt&&p(g.clearcoatNormalMap.channel),clearcoatRoughnessMapUv:Rt&&p(g.clearcoatRoughnessMap.channel),iridescenceMapUv:jt&&p(g.iridescenceMap.channel),iridescenceThicknessMapUv:$t&&p(g.iridescenceThicknessMap.channel),sheenColorMapUv:Lt&&p(g.sheenColorMap.channel),sheenRoughnessMapUv:ie&&p(g.sheenRoughnessMap.channel),specularMapUv:te&&p(g.specularMap.channel),specularColorMapUv:pe&&p(g.specularColorMap.channel),specularIntensityMapUv:q&&p(g.specularIntensityMap.channel),transmissionMapUv:Tt&&p(g.transmissionMap.channel),thicknessMapUv:lt&&p(g.thicknessMap.channel),alphaMapUv:Nt&&p(g.alphaMap.channel),vertexTangents:!!G.attributes.tangent&&(At||V),vertexColors:g.vertexColors,vertexAlphas:g.vertexColors===!0&&!!G.attributes.color&&G.attributes.color.itemSize===4,pointsUvs:F.isPoints===!0&&!!G.attributes.uv&&(at||Nt),fog:!!B,useFog:g.fog===!0,fogExp2:!!B&&B.isFogExp2,flatShading:g.flatShading===!0,sizeAttenuation:g.sizeAttenuation===!0,logarithmicDepthBuffer:f,reverseDepthBuffer:h,skinning:F.isSkinnedMesh===!0,morphTargets:G.morphAttributes.position!==void 0,morphNormals:G.morphAttributes.normal!==void 0,morphColors:G.morphAttributes.color!==void 0,morphTargetsCount:xt,morphTextureStride:Vt,numDirLights:m.directional.length,numPointLights:m.point.length,numSpotLights:m.spot.length,numSpotLightMaps:m.spotLightMap.length,numRectAreaLights:m.rectArea.length,numHemiLights:m.hemi.length,numDirLightShadows:m.directionalShadowMap.length,numPointLightShadows:m.pointShadowMap.length,numSpotLightShadows:m.spotShadowMap.length,numSpotLightShadowsWithMaps:m.numSpotLightShadowsWithMaps,numLightProbes:m.numLightProbes,numClippingPlanes:a.numPlanes,numClipIntersection:a.numIntersection,dithering:g.dithering,shadowMapEnabled:i.shadowMap.enabled&&E.length>0,shadowMapType:i.shadowMap.type,toneMapping:_n,decodeVideoTexture:at&&g.map.isVideoTexture===!0&&ye.getTransfer(g.map.colorSpace)===Fe,premultipliedAlpha:g.premultipliedAlpha,doubleSided:g.side===Fi,flipSided:g.side===On,useDepthPacking:g.depthPacking>=0,depthPacking:g.depthPacking||0,index0AttributeName:g.index0AttributeName,extensionClipCullDistance:We&&g.extensions.clipCullDistance===!0&&n.has("WEBGL_clip_cull_distance"),extensionMultiDraw:(We&&g.extensions.multiDraw===!0||Y)&&n.has("WEBGL_multi_draw"),rendererExtensionParallelShaderCompile:n.has("KHR_parallel_shader_compile"),customProgramCacheKey:g.customProgramCacheKey()};return bt.vertexUv1s=c.has(1),bt.vertexUv2s=c.has(2),bt.vertexUv3s=c.has(3),c.clear(),bt}function C(g){const m=[];if(g.shaderID?m.push(g.shaderID):(m.push(g.customVertexShaderID),m.push(g.customFragmentShaderID)),g.defines!==void 0)for(const E in g.defines)m.push(E),m.push(g.defines[E]);return g.isRawShaderMaterial===!1&&(b(m,g),R(m,g),m.push(i.outputColorSpace)),m.push(g.customProgramCacheKey),m.join()}function b(g,m){g.push(m.precision),g.push(m.outputColorSpace),g.push(m.envMapMode),g.push(m.envMapCubeUVHeight),g.push(m.mapUv),g.push(m.alphaMapUv),g.push(m.lightMapUv),g.push(m.aoMapUv),g.push(m.bumpMapUv),g.push(m.normalMapUv),g.push(m.displacementMapUv),g.push(m.emissiveMapUv),g.push(m.metalnessMapUv),g.push(m.roughnessMapUv),g.push(m.anisotropyMapUv),g.push(m.clearcoatMapUv),g.push(m.clearcoatNormalMapUv),g.push(m.clearcoatRoughnessMapUv),g.push(m.iridescenceMapUv),g.push(m.iridescenceThicknessMapUv),g.push(m.sheenColorMapUv),g.push(m.sheenRoughnessMapUv),g.push(m.specularMapUv),g.push(m.specularColorMapUv),g.push(m.specularIntensityMapUv),g.push(m.transmissionMapUv),g.push(m.thicknessMapUv),g.push(m.combine),g.push(m.fogExp2),g.push(m.sizeAttenuation),g.push(m.morphTargetsCount),g.push(m.morphAttributeCount),g.push(m.numDirLights),g.push(m.numPointLights),g.push(m.numSpotLights),g.push(m.numSpotLightMaps),g.push(m.numHemiLights),g.push(m.numRectAreaLights),g.push(m.numDirLightShadows),g.push(m.numPointLightShadows),g.push(m.numSpotLightShadows),g.push(m.numSpotLightShadowsWithMaps),g.push(m.numLightProbes),g.push(m.shadowMapType),g.push(m.toneMapping),g.push(m.numClippingPlanes),g.push(m.numClipIntersection),g.push(m.depthPacking)}function R(g,m){o.disableAll(),m.supportsVertexTextures&&o.enable(0),m.instancing&&o.enable(1),m.instancingColor&&o.enable(2),m.instancingMorph&&o.enable(3),m.matcap&&o.enable(4),m.envMap&&o.enable(5),m.normalMapObjectSpace&&o.enable(6),m.normalMapTangentSpace&&o.enable(7),m.clearcoat&&o.enable(8),m.iridescence&&o.enable(9),m.alphaTest&&o.enable(10),m.vertexColors&&o.enable(11),m.vertexAlphas&&o.enable(12),m.vertexUv1s&&o.enable(13),m.vertexUv2s&&o.enable(14),m.vertexUv3s&&o.enable(15),m.vertexTangents&&o.enable(16),m.anisotropy&&o.enable(17),m.alphaHash&&o.enable(18),m.batching&&o.enable(19),m.dispersion&&o.enable(20),m.batchingColor&&o.enable(21),g.push(o.mask),o.disableAll(),m.fog&&o.enable(0),m.useFog&&o.enable(1),m.flatShading&&o.enable(2),m.logarithmicDepthBuffer&&o.enable(3),m.reverseDepthBuffer&&o.enable(4),m.skinning&&o.enable(5),m.morphTargets&&o.enable(6),m.morphNormals&&o.enable(7),m.morphColors&&o.enable(8),m.premultipliedAlpha&&o.enable(9),m.shadowMapEnabled&&o.enable(10),m.doubleSided&&o.enable(11),m.flipSided&&o.enable(12),m.useDepthPacking&&o.enable(13),m.dithering&&o.enable(14),m.transmission&&o.enable(15),m.sheen&&o.enable(16),m.opaque&&o.enable(17),m.pointsUvs&&o.enable(18),m.decodeVideoTexture&&o.enable(19),m.alphaToCoverage&&o.enable(20),g.push(o.mask)}function D(g){const m=M[g.type];let E;if(m){const N=Si[m];E=K_.clone(N.uniforms)}else E=g.uniforms;return E}function A(g,m){let E;for(let N=0,F=u.length;N<F;N++){const B=u[N];if(B.cacheKey===m){E=B,++E.usedTimes;break}}return E===void 0&&(E=new ly(i,m,g,r),u.push(E)),E}function y(g){if(--g.usedTimes===0){const m=u.indexOf(g);u[m]=u[u.length-1],u.pop(),g.destroy()}}function P(g){l.remove(g)}function O(){l.dispose()}return{getParameters:d,getProgramCacheKey:C,getUniforms:D,acquireProgram:A,releaseProgram:y,releaseShaderCache:P,programs:u,dispose:O}}function dy(){let i=new WeakMap;function t(a){return i.has(a)}function e(a){let o=i.get(a);return o===void 0&&(o={},i.set(a,o)),o}function n(a){i.delete(a)}function s(a,o,l){i.get(a)[o]=l}function r(){i=new WeakMap}return{has:t,get:e,remove:n,update:s,dispose:r}}function py(i,t){return i.groupOrder!==t.groupOrder?i.groupOrder-t.groupOrder:i.renderOrder!==t.renderOrder?i.renderOrder-t.renderOrder:i.material.id!==t.material.id?i.material.id-t.material.id:i.z!==t.z?i.z-t.z:i.id-t.id}function Rf(i,t){return i.groupOrder!==t.groupOrder?i.groupOrder-t.groupOrder:i.renderOrder!==t.renderOrder?i.renderOrder-t.renderOrder:i.z!==t.z?t.z-i.z:i.id-t.id}function Cf(){const i=[];let t=0;const e=[],n=[],s=[];function r(){t=0,e.length=0,n.length=0,s.length=0}function a(f,h,_,x,M,p){let d=i[t];return d===void 0?(d={id:f.id,object:f,geometry:h,material:_,groupOrder:x,renderOrder:f.renderOrder,z:M,group:p},i[t]=d):(d.id=f.id,d.object=f,d.geometry=h,d.material=_,d.groupOrder=x,d.renderOrder=f.renderOrder,d.z=M,d.group=p),t++,d}function o(f,h,_,x,M,p){const d=a(f,h,_,x,M,p);_.transmission>0?n.push(d):_.transparent===!0?s.push(d):e.push(d)}function l(f,h,_,x,M,p){const d=a(f,h,_,x,M,p);_.transmission>0?n.unshift(d):_.transparent===!0?s.unshift(d):e.unshift(d)}function c(f,h){e.length>1&&e.sort(f||py),n.length>1&&n.sort(h||Rf),s.length>1&&s.sort(h||Rf)}function u(){for(let f=t,h=i.length;f<h;f++){const _=i[f];if(_.id===null)break;_.id=null,_.object=null,_.geometry=null,_.material=null,_.group=null}}return{opaque:e,transmissive:n,transparent:s,init:r,push:o,unshift:l,finish:u,sort:c}}function my(){let i=new WeakMap;function t(n,s){const r=i.get(n);let a;return r===void 0?(a=new Cf,i.set(n,[a])):s>=r.length?(a=new Cf,r.push(a)):a=r[s],a}function e(){i=new WeakMap}return{get:t,dispose:e}}function gy(){const i={};return{get:function(t){if(i[t.id]!==void 0)return i[t.id];let e;switch(t.type){case"DirectionalLight":e={direction:new j,color:new ne};break;case"SpotLight":e={position:new j,direction:new j,color:new ne,distance:0,coneCos:0,penumbraCos:0,decay:0};break;case"PointLight":e={position:new j,color:new ne,distance:0,decay:0};break;case"HemisphereLight":e={direction:new j,skyColor:new ne,groundColor:new ne};break;case"RectAreaLight":e={color:new ne,position:new j,halfWidth:new j,halfHeight:new j};break}return i[t.id]=e,e}}}function _y(){const i={};return{get:function(t){if(i[t.id]!==void 0)return i[t.id];let e;switch(t.type){case"DirectionalLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Qt};break;case"SpotLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Qt};break;case"PointLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Qt,shadowCameraNear:1,shadowCameraFar:1e3};break}return i[t.id]=e,e}}}let vy=0;function xy(i,t){return(t.castShadow?2:0)-(i.castShadow?2:0)+(t.map?1:0)-(i.map?1:0)}function My(i){const t=new gy,e=_y(),n={version:0,hash:{directionalLength:-1,pointLength:-1,spotLength:-1,rectAreaLength:-1,hemiLength:-1,numDirectionalShadows:-1,numPointShadows:-1,numSpotShadows:-1,numSpotMaps:-1,numLightProbes:-1},ambient:[0,0,0],probe:[],directional:[],directionalShadow:[],directionalShadowMap:[],directionalShadowMatrix:[],spot:[],spotLightMap:[],spotShadow:[],spotShadowMap:[],spotLightMatrix:[],rectArea:[],rectAreaLTC1:null,rectAreaLTC2:null,point:[],pointShadow:[],pointShadowMap:[],pointShadowMatrix:[],hemi:[],numSpotLightShadowsWithMaps:0,numLightProbes:0};for(let c=0;c<9;c++)n.probe.push(new j);const s=new j,r=new Ge,a=new Ge;function o(c){let u=0,f=0,h=0;for(let O=0;O<9;O++)n.probe[O].set(0,0,0);let _=0,x=0,M=0,p=0,d=0,C=0,b=0,R=0,D=0,A=0,y=0;c.sort(xy);for(let O=0,g=c.length;O<g;O++){const m=c[O],E=m.color,N=m.intensity,F=m.distance,B=m.shadow&&m.shadow.map?m.shadow.map.texture:null;if(m.isAmbientLight)u+=E.r*N,f+=E.g*N,h+=E.b*N;else if(m.isLightProbe){for(let G=0;G<9;G++)n.probe[G].addScaledVector(m.sh.coefficients[G],N);y++}else if(m.isDirectionalLight){const G=t.get(m);if(G.color.copy(m.color).multiplyScalar(m.intensity),m.castShadow){const $=m.shadow,Q=e.get(m);Q.shadowIntensity=$.intensity,Q.shadowBias=$.bias,Q.shadowNormalBias=$.normalBias,Q.shadowRadius=$.radius,Q.shadowMapSize=$.mapSize,n.directionalShadow[_]=Q,n.directionalShadowMap[_]=B,n.directionalShadowMatrix[_]=m.shadow.matrix,C++}n.directional[_]=G,_++}else if(m.isSpotLight){const G=t.get(m);G.position.setFromMatrixPosition(m.matrixWorld),G.color.copy(E).multiplyScalar(N),G.distance=F,G.coneCos=Math.cos(m.angle),G.penumbraCos=Math.cos(m.angle*(1-m.penumbra)),G.decay=m.decay,n.spot[M]=G;const $=m.shadow;if(m.map&&(n.spotLightMap[D]=m.map,D++,$.updateMatrices(m),m.castShadow&&A++),n.spotLightMatrix[M]=$.matrix,m.castShadow){const Q=e.get(m);Q.shadowIntensity=$.intensity,Q.shadowBias=$.bias,Q.shadowNormalBias=$.normalBias,Q.shadowRadius=$.radius,Q.shadowMapSize=$.mapSize,n.spotShadow[M]=Q,n.spotShadowMap[M]=B,R++}M++}else if(m.isRectAreaLight){const G=t.get(m);G.color.copy(E).multiplyScalar(N),G.halfWidth.set(m.width*.5,0,0),G.halfHeight.set(0,m.height*.5,0),n.rectArea[p]=G,p++}else if(m.isPointLight){const G=t.get(m);if(G.color.copy(m.color).multiplyScalar(m.intensity),G.distance=m.distance,G.decay=m.decay,m.castShadow){const $=m.shadow,Q=e.get(m);Q.shadowIntensity=$.intensity,Q.shadowBias=$.bias,Q.shadowNormalBias=$.normalBias,Q.shadowRadius=$.radius,Q.shadowMapSize=$.mapSize,Q.shadowCameraNear=$.camera.near,Q.shadowCameraFar=$.camera.far,n.pointShadow[x]=Q,n.pointShadowMap[x]=B,n.pointShadowMatrix[x]=m.shadow.matrix,b++}n.point[x]=G,x++}else if(m.isHemisphereLight){const G=t.get(m);G.skyColor.copy(m.color).multiplyScalar(N),G.groundColor.copy(m.groundColor).multiplyScalar(N),n.hemi[d]=G,d++}}p>0&&(i.has("OES_texture_float_linear")===!0?(n.rectAreaLTC1=Pt.LTC_FLOAT_1,n.rectAreaLTC2=Pt.LTC_FLOAT_2):(n.rectAreaLTC1=Pt.LTC_HALF_1,n.rectAreaLTC2=Pt.LTC_HALF_2)),n.ambient[0]=u,n.ambient[1]=f,n.ambient[2]=h;const P=n.hash;(P.directionalLength!==_||P.pointLength!==x||P.spotLength!==M||P.rectAreaLength!==p||P.hemiLength!==d||P.numDirectionalShadows!==C||P.numPointShadows!==b||P.numSpotShadows!==R||P.numSpotMaps!==D||P.numLightProbes!==y)&&(n.directional.length=_,n.spot.length=M,n.rectArea.length=p,n.point.length=x,n.hemi.length=d,n.directionalShadow.length=C,n.directionalShadowMap.length=C,n.pointShadow.length=b,n.pointShadowMap.length=b,n.spotShadow.length=R,n.spotShadowMap.length=R,n.directionalShadowMatrix.length=C,n.pointShadowMatrix.length=b,n.spotLightMatrix.length=R+D-A,n.spotLightMap.length=D,n.numSpotLightShadowsWithMaps=A,n.numLightProbes=y,P.directionalLength=_,P.pointLength=x,P.spotLength=M,P.rectAreaLength=p,P.hemiLength=d,P.numDirectionalShadows=C,P.numPointShadows=b,P.numSpotShadows=R,P.numSpotMaps=D,P.numLightProbes=y,n.version=vy++)}function l(c,u){let f=0,h=0,_=0,x=0,M=0;const p=u.matrixWorldInverse;for(let d=0,C=c.length;d<C;d++){const b=c[d];if(b.isDirectionalLight){const R=n.directional[f];R.direction.setFromMatrixPosition(b.matrixWorld),s.setFromMatrixPosition(b.target.matrixWorld),R.direction.sub(s),R.direction.transformDirection(p),f++}else if(b.isSpotLight){const R=n.spot[_];R.position.setFromMatrixPosition(b.matrixWorld),R.position.applyMatrix4(p),R.direction.setFromMatrixPosition(b.matrixWorld),s.setFromMatrixPosition(b.target.matrixWorld),R.direction.sub(s),R.direction.transformDirection(p),_++}else if(b.isRectAreaLight){const R=n.rectArea[x];R.position.setFromMatrixPosition(b.matrixWorld),R.position.applyMatrix4(p),a.identity(),r.copy(b.matrixWorld),r.premultiply(p),a.extractRotation(r),R.halfWidth.set(b.width*.5,0,0),R.halfHeight.set(0,b.height*.5,0),R.halfWidth.applyMatrix4(a),R.halfHeight.applyMatrix4(a),x++}else if(b.isPointLight){const R=n.point[h];R.position.setFromMatrixPosition(b.matrixWorld),R.position.applyMatrix4(p),h++}else if(b.isHemisphereLight){const R=n.hemi[M];R.direction.setFromMatrixPosition(b.matrixWorld),R.direction.transformDirection(p),M++}}}return{setup:o,setupView:l,state:n}}function Pf(i){const t=new My(i),e=[],n=[];function s(u){c.camera=u,e.length=0,n.length=0}function r(u){e.push(u)}function a(u){n.push(u)}function o(){t.setup(e)}function l(u){t.setupView(e,u)}const c={lightsArray:e,shadowsArray:n,camera:null,lights:t,transmissionRenderTarget:{}};return{init:s,state:c,setupLights:o,setupLightsView:l,pushLight:r,pushShadow:a}}function yy(i){let t=new WeakMap;function e(s,r=0){const a=t.get(s);let o;return a===void 0?(o=new Pf(i),t.set(s,[o])):r>=a.length?(o=new Pf(i),a.push(o)):o=a[r],o}function n(){t=new WeakMap}return{get:e,dispose:n}}class Sy extends Gs{constructor(t){super(),this.isMeshDepthMaterial=!0,this.type="MeshDepthMaterial",this.depthPacking=g_,this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.wireframe=!1,this.wireframeLinewidth=1,this.setValues(t)}copy(t){return super.copy(t),this.depthPacking=t.depthPacking,this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this}}class Ey extends Gs{constructor(t){super(),this.isMeshDistanceMaterial=!0,this.type="MeshDistanceMaterial",this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.setValues(t)}copy(t){return super.copy(t),this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this}}const wy=`void main() {
	gl_Position = vec4( position, 1.0 );
}`,by=`uniform sampler2D shadow_pass;
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
}`;function Ty(i,t,e){let n=new Bh;const s=new Qt,r=new Qt,a=new je,o=new Sy({depthPacking:__}),l=new Ey,c={},u=e.maxTextureSize,f={[us]:On,[On]:us,[Fi]:Fi},h=new fs({defines:{VSM_SAMPLES:8},uniforms:{shadow_pass:{value:null},resolution:{value:new Qt},radius:{value:4}},vertexShader:wy,fragmentShader:by}),_=h.clone();_.defines.HORIZONTAL_PASS=1;const x=new gn;x.setAttribute("position",new Wn(new Float32Array([-1,-1,.5,3,-1,.5,-1,3,.5]),3));const M=new rn(x,h),p=this;this.enabled=!1,this.autoUpdate=!0,this.needsUpdate=!1,this.type=Zd;let d=this.type;this.render=function(A,y,P){if(p.enabled===!1||p.autoUpdate===!1&&p.needsUpdate===!1||A.length===0)return;const O=i.getRenderTarget(),g=i.getActiveCubeFace(),m=i.getActiveMipmapLevel(),E=i.state;E.setBlending(os),E.buffers.color.setClear(1,1,1,1),E.buffers.depth.setTest(!0),E.setScissorTest(!1);const N=d!==Oi&&this.type===Oi,F=d===Oi&&this.type!==Oi;for(let B=0,G=A.length;B<G;B++){const $=A[B],Q=$.shadow;if(Q===void 0){console.warn("THREE.WebGLShadowMap:",$,"has no shadow.");continue}if(Q.autoUpdate===!1&&Q.needsUpdate===!1)continue;s.copy(Q.mapSize);const dt=Q.getFrameExtents();if(s.multiply(dt),r.copy(Q.mapSize),(s.x>u||s.y>u)&&(s.x>u&&(r.x=Math.floor(u/dt.x),s.x=r.x*dt.x,Q.mapSize.x=r.x),s.y>u&&(r.y=Math.floor(u/dt.y),s.y=r.y*dt.y,Q.mapSize.y=r.y)),Q.map===null||N===!0||F===!0){const gt=this.type!==Oi?{minFilter:ni,magFilter:ni}:{};Q.map!==null&&Q.map.dispose(),Q.map=new Fs(s.x,s.y,gt),Q.map.texture.name=$.name+".shadowMap",Q.camera.updateProjectionMatrix()}i.setRenderTarget(Q.map),i.clear();const ct=Q.getViewportCount();for(let gt=0;gt<ct;gt++){const xt=Q.getViewport(gt);a.set(r.x*xt.x,r.y*xt.y,r.x*xt.z,r.y*xt.w),E.viewport(a),Q.updateMatrices($,gt),n=Q.getFrustum(),R(y,P,Q.camera,$,this.type)}Q.isPointLightShadow!==!0&&this.type===Oi&&C(Q,P),Q.needsUpdate=!1}d=this.type,p.needsUpdate=!1,i.setRenderTarget(O,g,m)};function C(A,y){const P=t.update(M);h.defines.VSM_SAMPLES!==A.blurSamples&&(h.defines.VSM_SAMPLES=A.blurSamples,_.defines.VSM_SAMPLES=A.blurSamples,h.needsUpdate=!0,_.needsUpdate=!0),A.mapPass===null&&(A.mapPass=new Fs(s.x,s.y)),h.uniforms.shadow_pass.value=A.map.texture,h.uniforms.resolution.value=A.mapSize,h.uniforms.radius.value=A.radius,i.setRenderTarget(A.mapPass),i.clear(),i.renderBufferDirect(y,null,P,h,M,null),_.uniforms.shadow_pass.value=A.mapPass.texture,_.uniforms.resolution.value=A.mapSize,_.uniforms.radius.value=A.radius,i.setRenderTarget(A.map),i.clear(),i.renderBufferDirect(y,null,P,_,M,null)}function b(A,y,P,O){let g=null;const m=P.isPointLight===!0?A.customDistanceMaterial:A.customDepthMaterial;if(m!==void 0)g=m;else if(g=P.isPointLight===!0?l:o,i.localClippingEnabled&&y.clipShadows===!0&&Array.isArray(y.clippingPlanes)&&y.clippingPlanes.length!==0||y.displacementMap&&y.displacementScale!==0||y.alphaMap&&y.alphaTest>0||y.map&&y.alphaTest>0){const E=g.uuid,N=y.uuid;let F=c[E];F===void 0&&(F={},c[E]=F);let B=F[N];B===void 0&&(B=g.clone(),F[N]=B,y.addEventListener("dispose",D)),g=B}if(g.visible=y.visible,g.wireframe=y.wireframe,O===Oi?g.side=y.shadowSide!==null?y.shadowSide:y.side:g.side=y.shadowSide!==null?y.shadowSide:f[y.side],g.alphaMap=y.alphaMap,g.alphaTest=y.alphaTest,g.map=y.map,g.clipShadows=y.clipShadows,g.clippingPlanes=y.clippingPlanes,g.clipIntersection=y.clipIntersection,g.displacementMap=y.displacementMap,g.displacementScale=y.displacementScale,g.displacementBias=y.displacementBias,g.wireframeLinewidth=y.wireframeLinewidth,g.linewidth=y.linewidth,P.isPointLight===!0&&g.isMeshDistanceMaterial===!0){const E=i.properties.get(g);E.light=P}return g}function R(A,y,P,O,g){if(A.visible===!1)return;if(A.layers.test(y.layers)&&(A.isMesh||A.isLine||A.isPoints)&&(A.castShadow||A.receiveShadow&&g===Oi)&&(!A.frustumCulled||n.intersectsObject(A))){A.modelViewMatrix.multiplyMatrices(P.matrixWorldInverse,A.matrixWorld);const N=t.update(A),F=A.material;if(Array.isArray(F)){const B=N.groups;for(let G=0,$=B.length;G<$;G++){const Q=B[G],dt=F[Q.materialIndex];if(dt&&dt.visible){const ct=b(A,dt,O,g);A.onBeforeShadow(i,A,y,P,N,ct,Q),i.renderBufferDirect(P,null,N,ct,A,Q),A.onAfterShadow(i,A,y,P,N,ct,Q)}}}else if(F.visible){const B=b(A,F,O,g);A.onBeforeShadow(i,A,y,P,N,B,null),i.renderBufferDirect(P,null,N,B,A,null),A.onAfterShadow(i,A,y,P,N,B,null)}}const E=A.children;for(let N=0,F=E.length;N<F;N++)R(E[N],y,P,O,g)}function D(A){A.target.removeEventListener("dispose",D);for(const P in c){const O=c[P],g=A.target.uuid;g in O&&(O[g].dispose(),delete O[g])}}}const Ay={[Rc]:Cc,[Pc]:Ic,[Lc]:Uc,[Ur]:Dc,[Cc]:Rc,[Ic]:Pc,[Uc]:Lc,[Dc]:Ur};function Ry(i){function t(){let q=!1;const Tt=new je;let lt=null;const ft=new je(0,0,0,0);return{setMask:function(Nt){lt!==Nt&&!q&&(i.colorMask(Nt,Nt,Nt,Nt),lt=Nt)},setLocked:function(Nt){q=Nt},setClear:function(Nt,Bt,fe,We,_n){_n===!0&&(Nt*=We,Bt*=We,fe*=We),Tt.set(Nt,Bt,fe,We),ft.equals(Tt)===!1&&(i.clearColor(Nt,Bt,fe,We),ft.copy(Tt))},reset:function(){q=!1,lt=null,ft.set(-1,0,0,0)}}}function e(){let q=!1,Tt=!1,lt=null,ft=null,Nt=null;return{setReversed:function(Bt){Tt=Bt},setTest:function(Bt){Bt?Dt(i.DEPTH_TEST):St(i.DEPTH_TEST)},setMask:function(Bt){lt!==Bt&&!q&&(i.depthMask(Bt),lt=Bt)},setFunc:function(Bt){if(Tt&&(Bt=Ay[Bt]),ft!==Bt){switch(Bt){case Rc:i.depthFunc(i.NEVER);break;case Cc:i.depthFunc(i.ALWAYS);break;case Pc:i.depthFunc(i.LESS);break;case Ur:i.depthFunc(i.LEQUAL);break;case Lc:i.depthFunc(i.EQUAL);break;case Dc:i.depthFunc(i.GEQUAL);break;case Ic:i.depthFunc(i.GREATER);break;case Uc:i.depthFunc(i.NOTEQUAL);break;default:i.depthFunc(i.LEQUAL)}ft=Bt}},setLocked:function(Bt){q=Bt},setClear:function(Bt){Nt!==Bt&&(i.clearDepth(Bt),Nt=Bt)},reset:function(){q=!1,lt=null,ft=null,Nt=null}}}function n(){let q=!1,Tt=null,lt=null,ft=null,Nt=null,Bt=null,fe=null,We=null,_n=null;return{setTest:function(bt){q||(bt?Dt(i.STENCIL_TEST):St(i.STENCIL_TEST))},setMask:function(bt){Tt!==bt&&!q&&(i.stencilMask(bt),Tt=bt)},setFunc:function(bt,Xe,De){(lt!==bt||ft!==Xe||Nt!==De)&&(i.stencilFunc(bt,Xe,De),lt=bt,ft=Xe,Nt=De)},setOp:function(bt,Xe,De){(Bt!==bt||fe!==Xe||We!==De)&&(i.stencilOp(bt,Xe,De),Bt=bt,fe=Xe,We=De)},setLocked:function(bt){q=bt},setClear:function(bt){_n!==bt&&(i.clearStencil(bt),_n=bt)},reset:function(){q=!1,Tt=null,lt=null,ft=null,Nt=null,Bt=null,fe=null,We=null,_n=null}}}const s=new t,r=new e,a=new n,o=new WeakMap,l=new WeakMap;let c={},u={},f=new WeakMap,h=[],_=null,x=!1,M=null,p=null,d=null,C=null,b=null,R=null,D=null,A=new ne(0,0,0),y=0,P=!1,O=null,g=null,m=null,E=null,N=null;const F=i.getParameter(i.MAX_COMBINED_TEXTURE_IMAGE_UNITS);let B=!1,G=0;const $=i.getParameter(i.VERSION);$.indexOf("WebGL")!==-1?(G=parseFloat(/^WebGL (\d)/.exec($)[1]),B=G>=1):$.indexOf("OpenGL ES")!==-1&&(G=parseFloat(/^OpenGL ES (\d)/.exec($)[1]),B=G>=2);let Q=null,dt={};const ct=i.getParameter(i.SCISSOR_BOX),gt=i.getParameter(i.VIEWPORT),xt=new je().fromArray(ct),Vt=new je().fromArray(gt);function rt(q,Tt,lt,ft){const Nt=new Uint8Array(4),Bt=i.createTexture();i.bindTexture(q,Bt),i.texParameteri(q,i.TEXTURE_MIN_FILTER,i.NEAREST),i.texParameteri(q,i.TEXTURE_MAG_FILTER,i.NEAREST);for(let fe=0;fe<lt;fe++)q===i.TEXTURE_3D||q===i.TEXTURE_2D_ARRAY?i.texImage3D(Tt,0,i.RGBA,1,1,ft,0,i.RGBA,i.UNSIGNED_BYTE,Nt):i.texImage2D(Tt+fe,0,i.RGBA,1,1,0,i.RGBA,i.UNSIGNED_BYTE,Nt);return Bt}const pt={};pt[i.TEXTURE_2D]=rt(i.TEXTURE_2D,i.TEXTURE_2D,1),pt[i.TEXTURE_CUBE_MAP]=rt(i.TEXTURE_CUBE_MAP,i.TEXTURE_CUBE_MAP_POSITIVE_X,6),pt[i.TEXTURE_2D_ARRAY]=rt(i.TEXTURE_2D_ARRAY,i.TEXTURE_2D_ARRAY,1,1),pt[i.TEXTURE_3D]=rt(i.TEXTURE_3D,i.TEXTURE_3D,1,1),s.setClear(0,0,0,1),r.setClear(1),a.setClear(0),Dt(i.DEPTH_TEST),r.setFunc(Ur),Mt(!1),Ht(Fu),Dt(i.CULL_FACE),I(os);function Dt(q){c[q]!==!0&&(i.enable(q),c[q]=!0)}function St(q){c[q]!==!1&&(i.disable(q),c[q]=!1)}function Z(q,Tt){return u[q]!==Tt?(i.bindFramebuffer(q,Tt),u[q]=Tt,q===i.DRAW_FRAMEBUFFER&&(u[i.FRAMEBUFFER]=Tt),q===i.FRAMEBUFFER&&(u[i.DRAW_FRAMEBUFFER]=Tt),!0):!1}function J(q,Tt){let lt=h,ft=!1;if(q){lt=f.get(Tt),lt===void 0&&(lt=[],f.set(Tt,lt));const Nt=q.textures;if(lt.length!==Nt.length||lt[0]!==i.COLOR_ATTACHMENT0){for(let Bt=0,fe=Nt.length;Bt<fe;Bt++)lt[Bt]=i.COLOR_ATTACHMENT0+Bt;lt.length=Nt.length,ft=!0}}else lt[0]!==i.BACK&&(lt[0]=i.BACK,ft=!0);ft&&i.drawBuffers(lt)}function Y(q){return _!==q?(i.useProgram(q),_=q,!0):!1}const at={[Rs]:i.FUNC_ADD,[Vg]:i.FUNC_SUBTRACT,[Wg]:i.FUNC_REVERSE_SUBTRACT};at[Xg]=i.MIN,at[qg]=i.MAX;const ot={[Yg]:i.ZERO,[jg]:i.ONE,[Kg]:i.SRC_COLOR,[Tc]:i.SRC_ALPHA,[e_]:i.SRC_ALPHA_SATURATE,[Qg]:i.DST_COLOR,[Zg]:i.DST_ALPHA,[$g]:i.ONE_MINUS_SRC_COLOR,[Ac]:i.ONE_MINUS_SRC_ALPHA,[t_]:i.ONE_MINUS_DST_COLOR,[Jg]:i.ONE_MINUS_DST_ALPHA,[n_]:i.CONSTANT_COLOR,[i_]:i.ONE_MINUS_CONSTANT_COLOR,[s_]:i.CONSTANT_ALPHA,[r_]:i.ONE_MINUS_CONSTANT_ALPHA};function I(q,Tt,lt,ft,Nt,Bt,fe,We,_n,bt){if(q===os){x===!0&&(St(i.BLEND),x=!1);return}if(x===!1&&(Dt(i.BLEND),x=!0),q!==Gg){if(q!==M||bt!==P){if((p!==Rs||b!==Rs)&&(i.blendEquation(i.FUNC_ADD),p=Rs,b=Rs),bt)switch(q){case Pr:i.blendFuncSeparate(i.ONE,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case Bu:i.blendFunc(i.ONE,i.ONE);break;case zu:i.blendFuncSeparate(i.ZERO,i.ONE_MINUS_SRC_COLOR,i.ZERO,i.ONE);break;case Hu:i.blendFuncSeparate(i.ZERO,i.SRC_COLOR,i.ZERO,i.SRC_ALPHA);break;default:console.error("THREE.WebGLState: Invalid blending: ",q);break}else switch(q){case Pr:i.blendFuncSeparate(i.SRC_ALPHA,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case Bu:i.blendFunc(i.SRC_ALPHA,i.ONE);break;case zu:i.blendFuncSeparate(i.ZERO,i.ONE_MINUS_SRC_COLOR,i.ZERO,i.ONE);break;case Hu:i.blendFunc(i.ZERO,i.SRC_COLOR);break;default:console.error("THREE.WebGLState: Invalid blending: ",q);break}d=null,C=null,R=null,D=null,A.set(0,0,0),y=0,M=q,P=bt}return}Nt=Nt||Tt,Bt=Bt||lt,fe=fe||ft,(Tt!==p||Nt!==b)&&(i.blendEquationSeparate(at[Tt],at[Nt]),p=Tt,b=Nt),(lt!==d||ft!==C||Bt!==R||fe!==D)&&(i.blendFuncSeparate(ot[lt],ot[ft],ot[Bt],ot[fe]),d=lt,C=ft,R=Bt,D=fe),(We.equals(A)===!1||_n!==y)&&(i.blendColor(We.r,We.g,We.b,_n),A.copy(We),y=_n),M=q,P=!1}function Ot(q,Tt){q.side===Fi?St(i.CULL_FACE):Dt(i.CULL_FACE);let lt=q.side===On;Tt&&(lt=!lt),Mt(lt),q.blending===Pr&&q.transparent===!1?I(os):I(q.blending,q.blendEquation,q.blendSrc,q.blendDst,q.blendEquationAlpha,q.blendSrcAlpha,q.blendDstAlpha,q.blendColor,q.blendAlpha,q.premultipliedAlpha),r.setFunc(q.depthFunc),r.setTest(q.depthTest),r.setMask(q.depthWrite),s.setMask(q.colorWrite);const ft=q.stencilWrite;a.setTest(ft),ft&&(a.setMask(q.stencilWriteMask),a.setFunc(q.stencilFunc,q.stencilRef,q.stencilFuncMask),a.setOp(q.stencilFail,q.stencilZFail,q.stencilZPass)),Et(q.polygonOffset,q.polygonOffsetFactor,q.polygonOffsetUnits),q.alphaToCoverage===!0?Dt(i.SAMPLE_ALPHA_TO_COVERAGE):St(i.SAMPLE_ALPHA_TO_COVERAGE)}function Mt(q){O!==q&&(q?i.frontFace(i.CW):i.frontFace(i.CCW),O=q)}function Ht(q){q!==Bg?(Dt(i.CULL_FACE),q!==g&&(q===Fu?i.cullFace(i.BACK):q===zg?i.cullFace(i.FRONT):i.cullFace(i.FRONT_AND_BACK))):St(i.CULL_FACE),g=q}function At(q){q!==m&&(B&&i.lineWidth(q),m=q)}function Et(q,Tt,lt){q?(Dt(i.POLYGON_OFFSET_FILL),(E!==Tt||N!==lt)&&(i.polygonOffset(Tt,lt),E=Tt,N=lt)):St(i.POLYGON_OFFSET_FILL)}function Xt(q){q?Dt(i.SCISSOR_TEST):St(i.SCISSOR_TEST)}function L(q){q===void 0&&(q=i.TEXTURE0+F-1),Q!==q&&(i.activeTexture(q),Q=q)}function w(q,Tt,lt){lt===void 0&&(Q===null?lt=i.TEXTURE0+F-1:lt=Q);let ft=dt[lt];ft===void 0&&(ft={type:void 0,texture:void 0},dt[lt]=ft),(ft.type!==q||ft.texture!==Tt)&&(Q!==lt&&(i.activeTexture(lt),Q=lt),i.bindTexture(q,Tt||pt[q]),ft.type=q,ft.texture=Tt)}function V(){const q=dt[Q];q!==void 0&&q.type!==void 0&&(i.bindTexture(q.type,null),q.type=void 0,q.texture=void 0)}function it(){try{i.compressedTexImage2D.apply(i,arguments)}catch(q){console.error("THREE.WebGLState:",q)}}function ht(){try{i.compressedTexImage3D.apply(i,arguments)}catch(q){console.error("THREE.WebGLState:",q)}}function nt(){try{i.texSubImage2D.apply(i,arguments)}catch(q){console.error("THREE.WebGLState:",q)}}function It(){try{i.texSubImage3D.apply(i,arguments)}catch(q){console.error("THREE.WebGLState:",q)}}function wt(){try{i.compressedTexSubImage2D.apply(i,arguments)}catch(q){console.error("THREE.WebGLState:",q)}}function Ut(){try{i.compressedTexSubImage3D.apply(i,arguments)}catch(q){console.error("THREE.WebGLState:",q)}}function re(){try{i.texStorage2D.apply(i,arguments)}catch(q){console.error("THREE.WebGLState:",q)}}function mt(){try{i.texStorage3D.apply(i,arguments)}catch(q){console.error("THREE.WebGLState:",q)}}function Rt(){try{i.texImage2D.apply(i,arguments)}catch(q){console.error("THREE.WebGLState:",q)}}function jt(){try{i.texImage3D.apply(i,arguments)}catch(q){console.error("THREE.WebGLState:",q)}}function $t(q){xt.equals(q)===!1&&(i.scissor(q.x,q.y,q.z,q.w),xt.copy(q))}function Lt(q){Vt.equals(q)===!1&&(i.viewport(q.x,q.y,q.z,q.w),Vt.copy(q))}function ie(q,Tt){let lt=l.get(Tt);lt===void 0&&(lt=new WeakMap,l.set(Tt,lt));let ft=lt.get(q);ft===void 0&&(ft=i.getUniformBlockIndex(Tt,q.name),lt.set(q,ft))}function te(q,Tt){const ft=l.get(Tt).get(q);o.get(Tt)!==ft&&(i.uniformBlockBinding(Tt,ft,q.__bindingPointIndex),o.set(Tt,ft))}function pe(){i.disable(i.BLEND),i.disable(i.CULL_FACE),i.disable(i.DEPTH_TEST),i.disable(i.POLYGON_OFFSET_FILL),i.disable(i.SCISSOR_TEST),i.disable(i.STENCIL_TEST),i.disable(i.SAMPLE_ALPHA_TO_COVERAGE),i.blendEquation(i.FUNC_ADD),i.blendFunc(i.ONE,i.ZERO),i.blendFuncSeparate(i.ONE,i.ZERO,i.ONE,i.ZERO),i.blendColor(0,0,0,0),i.colorMask(!0,!0,!0,!0),i.clearColor(0,0,0,0),i.depthMask(!0),i.depthFunc(i.LESS),i.clearDepth(1),i.stencilMask(4294967295),i.stencilFunc(i.ALWAYS,0,4294967295),i.stencilOp(i.KEEP,i.KEEP,i.KEEP),i.clearStencil(0),i.cullFace(i.BACK),i.frontFace(i.CCW),i.polygonOffset(0,0),i.activeTexture(i.TEXTURE0),i.bindFramebuffer(i.FRAMEBUFFER,null),i.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),i.bindFramebuffer(i.READ_FRAMEBUFFER,null),i.useProgram(null),i.lineWidth(1),i.scissor(0,0,i.canvas.width,i.canvas.height),i.viewport(0,0,i.canvas.width,i.canvas.height),c={},Q=null,dt={},u={},f=new WeakMap,h=[],_=null,x=!1,M=null,p=null,d=null,C=null,b=null,R=null,D=null,A=new ne(0,0,0),y=0,P=!1,O=null,g=null,m=null,E=null,N=null,xt.set(0,0,i.canvas.width,i.canvas.height),Vt.set(0,0,i.canvas.width,i.canvas.height),s.reset(),r.reset(),a.reset()}return{buffers:{color:s,depth:r,stencil:a},enable:Dt,disable:St,bindFramebuffer:Z,drawBuffers:J,useProgram:Y,setBlending:I,setMaterial:Ot,setFlipSided:Mt,setCullFace:Ht,setLineWidth:At,setPolygonOffset:Et,setScissorTest:Xt,activeTexture:L,bindTexture:w,unbindTexture:V,compressedTexImage2D:it,compressedTexImage3D:ht,texImage2D:Rt,texImage3D:jt,updateUBOMapping:ie,uniformBlockBinding:te,texStorage2D:re,texStorage3D:mt,texSubImage2D:nt,texSubImage3D:It,compressedTexSubImage2D:wt,compressedTexSubImage3D:Ut,scissor:$t,viewport:Lt,reset:pe}}function Lf(i,t,e,n){const s=Cy(n);switch(e){case np:return i*t;case sp:return i*t;case rp:return i*t*2;case ap:return i*t/s.components*s.byteLength;case Uh:return i*t/s.components*s.byteLength;case op:return i*t*2/s.components*s.byteLength;case Nh:return i*t*2/s.components*s.byteLength;case ip:return i*t*3/s.components*s.byteLength;case fi:return i*t*4/s.components*s.byteLength;case kh:return i*t*4/s.components*s.byteLength;case Ro:case Co:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*8;case Po:case Lo:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*16;case zc:case Gc:return Math.max(i,16)*Math.max(t,8)/4;case Bc:case Hc:return Math.max(i,8)*Math.max(t,8)/2;case Vc:case Wc:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*8;case Xc:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*16;case qc:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*16;case Yc:return Math.floor((i+4)/5)*Math.floor((t+3)/4)*16;case jc:return Math.floor((i+4)/5)*Math.floor((t+4)/5)*16;case Kc:return Math.floor((i+5)/6)*Math.floor((t+4)/5)*16;case $c:return Math.floor((i+5)/6)*Math.floor((t+5)/6)*16;case Zc:return Math.floor((i+7)/8)*Math.floor((t+4)/5)*16;case Jc:return Math.floor((i+7)/8)*Math.floor((t+5)/6)*16;case Qc:return Math.floor((i+7)/8)*Math.floor((t+7)/8)*16;case th:return Math.floor((i+9)/10)*Math.floor((t+4)/5)*16;case eh:return Math.floor((i+9)/10)*Math.floor((t+5)/6)*16;case nh:return Math.floor((i+9)/10)*Math.floor((t+7)/8)*16;case ih:return Math.floor((i+9)/10)*Math.floor((t+9)/10)*16;case sh:return Math.floor((i+11)/12)*Math.floor((t+9)/10)*16;case rh:return Math.floor((i+11)/12)*Math.floor((t+11)/12)*16;case Do:case ah:case oh:return Math.ceil(i/4)*Math.ceil(t/4)*16;case lp:case lh:return Math.ceil(i/4)*Math.ceil(t/4)*8;case ch:case hh:return Math.ceil(i/4)*Math.ceil(t/4)*16}throw new Error(`Unable to determine texture byte length for ${e} format.`)}function Cy(i){switch(i){case Vi:case Qd:return{byteLength:1,components:1};case Aa:case tp:case Pa:return{byteLength:2,components:1};case Dh:case Ih:return{byteLength:2,components:4};case Os:case Lh:case Bi:return{byteLength:4,components:1};case ep:return{byteLength:4,components:3}}throw new Error(`Unknown texture type ${i}.`)}function Py(i,t,e,n,s,r,a){const o=t.has("WEBGL_multisampled_render_to_texture")?t.get("WEBGL_multisampled_render_to_texture"):null,l=typeof navigator>"u"?!1:/OculusBrowser/g.test(navigator.userAgent),c=new Qt,u=new WeakMap;let f;const h=new WeakMap;let _=!1;try{_=typeof OffscreenCanvas<"u"&&new OffscreenCanvas(1,1).getContext("2d")!==null}catch{}function x(L,w){return _?new OffscreenCanvas(L,w):Wo("canvas")}function M(L,w,V){let it=1;const ht=Xt(L);if((ht.width>V||ht.height>V)&&(it=V/Math.max(ht.width,ht.height)),it<1)if(typeof HTMLImageElement<"u"&&L instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&L instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&L instanceof ImageBitmap||typeof VideoFrame<"u"&&L instanceof VideoFrame){const nt=Math.floor(it*ht.width),It=Math.floor(it*ht.height);f===void 0&&(f=x(nt,It));const wt=w?x(nt,It):f;return wt.width=nt,wt.height=It,wt.getContext("2d").drawImage(L,0,0,nt,It),console.warn("THREE.WebGLRenderer: Texture has been resized from ("+ht.width+"x"+ht.height+") to ("+nt+"x"+It+")."),wt}else return"data"in L&&console.warn("THREE.WebGLRenderer: Image in DataTexture is too big ("+ht.width+"x"+ht.height+")."),L;return L}function p(L){return L.generateMipmaps&&L.minFilter!==ni&&L.minFilter!==ti}function d(L){i.generateMipmap(L)}function C(L,w,V,it,ht=!1){if(L!==null){if(i[L]!==void 0)return i[L];console.warn("THREE.WebGLRenderer: Attempt to use non-existing WebGL internal format '"+L+"'")}let nt=w;if(w===i.RED&&(V===i.FLOAT&&(nt=i.R32F),V===i.HALF_FLOAT&&(nt=i.R16F),V===i.UNSIGNED_BYTE&&(nt=i.R8)),w===i.RED_INTEGER&&(V===i.UNSIGNED_BYTE&&(nt=i.R8UI),V===i.UNSIGNED_SHORT&&(nt=i.R16UI),V===i.UNSIGNED_INT&&(nt=i.R32UI),V===i.BYTE&&(nt=i.R8I),V===i.SHORT&&(nt=i.R16I),V===i.INT&&(nt=i.R32I)),w===i.RG&&(V===i.FLOAT&&(nt=i.RG32F),V===i.HALF_FLOAT&&(nt=i.RG16F),V===i.UNSIGNED_BYTE&&(nt=i.RG8)),w===i.RG_INTEGER&&(V===i.UNSIGNED_BYTE&&(nt=i.RG8UI),V===i.UNSIGNED_SHORT&&(nt=i.RG16UI),V===i.UNSIGNED_INT&&(nt=i.RG32UI),V===i.BYTE&&(nt=i.RG8I),V===i.SHORT&&(nt=i.RG16I),V===i.INT&&(nt=i.RG32I)),w===i.RGB_INTEGER&&(V===i.UNSIGNED_BYTE&&(nt=i.RGB8UI),V===i.UNSIGNED_SHORT&&(nt=i.RGB16UI),V===i.UNSIGNED_INT&&(nt=i.RGB32UI),V===i.BYTE&&(nt=i.RGB8I),V===i.SHORT&&(nt=i.RGB16I),V===i.INT&&(nt=i.RGB32I)),w===i.RGBA_INTEGER&&(V===i.UNSIGNED_BYTE&&(nt=i.RGBA8UI),V===i.UNSIGNED_SHORT&&(nt=i.RGBA16UI),V===i.UNSIGNED_INT&&(nt=i.RGBA32UI),V===i.BYTE&&(nt=i.RGBA8I),V===i.SHORT&&(nt=i.RGBA16I),V===i.INT&&(nt=i.RGBA32I)),w===i.RGB&&V===i.UNSIGNED_INT_5_9_9_9_REV&&(nt=i.RGB9_E5),w===i.RGBA){const It=ht?zo:ye.getTransfer(it);V===i.FLOAT&&(nt=i.RGBA32F),V===i.HALF_FLOAT&&(nt=i.RGBA16F),V===i.UNSIGNED_BYTE&&(nt=It===Fe?i.SRGB8_ALPHA8:i.RGBA8),V===i.UNSIGNED_SHORT_4_4_4_4&&(nt=i.RGBA4),V===i.UNSIGNED_SHORT_5_5_5_1&&(nt=i.RGB5_A1)}return(nt===i.R16F||nt===i.R32F||nt===i.RG16F||nt===i.RG32F||nt===i.RGBA16F||nt===i.RGBA32F)&&t.get("EXT_color_buffer_float"),nt}function b(L,w){let V;return L?w===null||w===Os||w===Or?V=i.DEPTH24_STENCIL8:w===Bi?V=i.DEPTH32F_STENCIL8:w===Aa&&(V=i.DEPTH24_STENCIL8,console.warn("DepthTexture: 16 bit depth attachment is not supported with stencil. Using 24-bit attachment.")):w===null||w===Os||w===Or?V=i.DEPTH_COMPONENT24:w===Bi?V=i.DEPTH_COMPONENT32F:w===Aa&&(V=i.DEPTH_COMPONENT16),V}function R(L,w){return p(L)===!0||L.isFramebufferTexture&&L.minFilter!==ni&&L.minFilter!==ti?Math.log2(Math.max(w.width,w.height))+1:L.mipmaps!==void 0&&L.mipmaps.length>0?L.mipmaps.length:L.isCompressedTexture&&Array.isArray(L.image)?w.mipmaps.length:1}function D(L){const w=L.target;w.removeEventListener("dispose",D),y(w),w.isVideoTexture&&u.delete(w)}function A(L){const w=L.target;w.removeEventListener("dispose",A),O(w)}function y(L){const w=n.get(L);if(w.__webglInit===void 0)return;const V=L.source,it=h.get(V);if(it){const ht=it[w.__cacheKey];ht.usedTimes--,ht.usedTimes===0&&P(L),Object.keys(it).length===0&&h.delete(V)}n.remove(L)}function P(L){const w=n.get(L);i.deleteTexture(w.__webglTexture);const V=L.source,it=h.get(V);delete it[w.__cacheKey],a.memory.textures--}function O(L){const w=n.get(L);if(L.depthTexture&&L.depthTexture.dispose(),L.isWebGLCubeRenderTarget)for(let it=0;it<6;it++){if(Array.isArray(w.__webglFramebuffer[it]))for(let ht=0;ht<w.__webglFramebuffer[it].length;ht++)i.deleteFramebuffer(w.__webglFramebuffer[it][ht]);else i.deleteFramebuffer(w.__webglFramebuffer[it]);w.__webglDepthbuffer&&i.deleteRenderbuffer(w.__webglDepthbuffer[it])}else{if(Array.isArray(w.__webglFramebuffer))for(let it=0;it<w.__webglFramebuffer.length;it++)i.deleteFramebuffer(w.__webglFramebuffer[it]);else i.deleteFramebuffer(w.__webglFramebuffer);if(w.__webglDepthbuffer&&i.deleteRenderbuffer(w.__webglDepthbuffer),w.__webglMultisampledFramebuffer&&i.deleteFramebuffer(w.__webglMultisampledFramebuffer),w.__webglColorRenderbuffer)for(let it=0;it<w.__webglColorRenderbuffer.length;it++)w.__webglColorRenderbuffer[it]&&i.deleteRenderbuffer(w.__webglColorRenderbuffer[it]);w.__webglDepthRenderbuffer&&i.deleteRenderbuffer(w.__webglDepthRenderbuffer)}const V=L.textures;for(let it=0,ht=V.length;it<ht;it++){const nt=n.get(V[it]);nt.__webglTexture&&(i.deleteTexture(nt.__webglTexture),a.memory.textures--),n.remove(V[it])}n.remove(L)}let g=0;function m(){g=0}function E(){const L=g;return L>=s.maxTextures&&console.warn("THREE.WebGLTextures: Trying to use "+L+" texture units while this GPU supports only "+s.maxTextures),g+=1,L}function N(L){const w=[];return w.push(L.wrapS),w.push(L.wrapT),w.push(L.wrapR||0),w.push(L.magFilter),w.push(L.minFilter),w.push(L.anisotropy),w.push(L.internalFormat),w.push(L.format),w.push(L.type),w.push(L.generateMipmaps),w.push(L.premultiplyAlpha),w.push(L.flipY),w.push(L.unpackAlignment),w.push(L.colorSpace),w.join()}function F(L,w){const V=n.get(L);if(L.isVideoTexture&&At(L),L.isRenderTargetTexture===!1&&L.version>0&&V.__version!==L.version){const it=L.image;if(it===null)console.warn("THREE.WebGLRenderer: Texture marked for update but no image data found.");else if(it.complete===!1)console.warn("THREE.WebGLRenderer: Texture marked for update but image is incomplete");else{Vt(V,L,w);return}}e.bindTexture(i.TEXTURE_2D,V.__webglTexture,i.TEXTURE0+w)}function B(L,w){const V=n.get(L);if(L.version>0&&V.__version!==L.version){Vt(V,L,w);return}e.bindTexture(i.TEXTURE_2D_ARRAY,V.__webglTexture,i.TEXTURE0+w)}function G(L,w){const V=n.get(L);if(L.version>0&&V.__version!==L.version){Vt(V,L,w);return}e.bindTexture(i.TEXTURE_3D,V.__webglTexture,i.TEXTURE0+w)}function $(L,w){const V=n.get(L);if(L.version>0&&V.__version!==L.version){rt(V,L,w);return}e.bindTexture(i.TEXTURE_CUBE_MAP,V.__webglTexture,i.TEXTURE0+w)}const Q={[Oc]:i.REPEAT,[Ls]:i.CLAMP_TO_EDGE,[Fc]:i.MIRRORED_REPEAT},dt={[ni]:i.NEAREST,[m_]:i.NEAREST_MIPMAP_NEAREST,[Va]:i.NEAREST_MIPMAP_LINEAR,[ti]:i.LINEAR,[Cl]:i.LINEAR_MIPMAP_NEAREST,[Ds]:i.LINEAR_MIPMAP_LINEAR},ct={[x_]:i.NEVER,[b_]:i.ALWAYS,[M_]:i.LESS,[hp]:i.LEQUAL,[y_]:i.EQUAL,[w_]:i.GEQUAL,[S_]:i.GREATER,[E_]:i.NOTEQUAL};function gt(L,w){if(w.type===Bi&&t.has("OES_texture_float_linear")===!1&&(w.magFilter===ti||w.magFilter===Cl||w.magFilter===Va||w.magFilter===Ds||w.minFilter===ti||w.minFilter===Cl||w.minFilter===Va||w.minFilter===Ds)&&console.warn("THREE.WebGLRenderer: Unable to use linear filtering with floating point textures. OES_texture_float_linear not supported on this device."),i.texParameteri(L,i.TEXTURE_WRAP_S,Q[w.wrapS]),i.texParameteri(L,i.TEXTURE_WRAP_T,Q[w.wrapT]),(L===i.TEXTURE_3D||L===i.TEXTURE_2D_ARRAY)&&i.texParameteri(L,i.TEXTURE_WRAP_R,Q[w.wrapR]),i.texParameteri(L,i.TEXTURE_MAG_FILTER,dt[w.magFilter]),i.texParameteri(L,i.TEXTURE_MIN_FILTER,dt[w.minFilter]),w.compareFunction&&(i.texParameteri(L,i.TEXTURE_COMPARE_MODE,i.COMPARE_REF_TO_TEXTURE),i.texParameteri(L,i.TEXTURE_COMPARE_FUNC,ct[w.compareFunction])),t.has("EXT_texture_filter_anisotropic")===!0){if(w.magFilter===ni||w.minFilter!==Va&&w.minFilter!==Ds||w.type===Bi&&t.has("OES_texture_float_linear")===!1)return;if(w.anisotropy>1||n.get(w).__currentAnisotropy){const V=t.get("EXT_texture_filter_anisotropic");i.texParameterf(L,V.TEXTURE_MAX_ANISOTROPY_EXT,Math.min(w.anisotropy,s.getMaxAnisotropy())),n.get(w).__currentAnisotropy=w.anisotropy}}}function xt(L,w){let V=!1;L.__webglInit===void 0&&(L.__webglInit=!0,w.addEventListener("dispose",D));const it=w.source;let ht=h.get(it);ht===void 0&&(ht={},h.set(it,ht));const nt=N(w);if(nt!==L.__cacheKey){ht[nt]===void 0&&(ht[nt]={texture:i.createTexture(),usedTimes:0},a.memory.textures++,V=!0),ht[nt].usedTimes++;const It=ht[L.__cacheKey];It!==void 0&&(ht[L.__cacheKey].usedTimes--,It.usedTimes===0&&P(w)),L.__cacheKey=nt,L.__webglTexture=ht[nt].texture}return V}function Vt(L,w,V){let it=i.TEXTURE_2D;(w.isDataArrayTexture||w.isCompressedArrayTexture)&&(it=i.TEXTURE_2D_ARRAY),w.isData3DTexture&&(it=i.TEXTURE_3D);const ht=xt(L,w),nt=w.source;e.bindTexture(it,L.__webglTexture,i.TEXTURE0+V);const It=n.get(nt);if(nt.version!==It.__version||ht===!0){e.activeTexture(i.TEXTURE0+V);const wt=ye.getPrimaries(ye.workingColorSpace),Ut=w.colorSpace===is?null:ye.getPrimaries(w.colorSpace),re=w.colorSpace===is||wt===Ut?i.NONE:i.BROWSER_DEFAULT_WEBGL;i.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,w.flipY),i.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,w.premultiplyAlpha),i.pixelStorei(i.UNPACK_ALIGNMENT,w.unpackAlignment),i.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,re);let mt=M(w.image,!1,s.maxTextureSize);mt=Et(w,mt);const Rt=r.convert(w.format,w.colorSpace),jt=r.convert(w.type);let $t=C(w.internalFormat,Rt,jt,w.colorSpace,w.isVideoTexture);gt(it,w);let Lt;const ie=w.mipmaps,te=w.isVideoTexture!==!0,pe=It.__version===void 0||ht===!0,q=nt.dataReady,Tt=R(w,mt);if(w.isDepthTexture)$t=b(w.format===Fr,w.type),pe&&(te?e.texStorage2D(i.TEXTURE_2D,1,$t,mt.width,mt.height):e.texImage2D(i.TEXTURE_2D,0,$t,mt.width,mt.height,0,Rt,jt,null));else if(w.isDataTexture)if(ie.length>0){te&&pe&&e.texStorage2D(i.TEXTURE_2D,Tt,$t,ie[0].width,ie[0].height);for(let lt=0,ft=ie.length;lt<ft;lt++)Lt=ie[lt],te?q&&e.texSubImage2D(i.TEXTURE_2D,lt,0,0,Lt.width,Lt.height,Rt,jt,Lt.data):e.texImage2D(i.TEXTURE_2D,lt,$t,Lt.width,Lt.height,0,Rt,jt,Lt.data);w.generateMipmaps=!1}else te?(pe&&e.texStorage2D(i.TEXTURE_2D,Tt,$t,mt.width,mt.height),q&&e.texSubImage2D(i.TEXTURE_2D,0,0,0,mt.width,mt.height,Rt,jt,mt.data)):e.texImage2D(i.TEXTURE_2D,0,$t,mt.width,mt.height,0,Rt,jt,mt.data);else if(w.isCompressedTexture)if(w.isCompressedArrayTexture){te&&pe&&e.texStorage3D(i.TEXTURE_2D_ARRAY,Tt,$t,ie[0].width,ie[0].height,mt.depth);for(let lt=0,ft=ie.length;lt<ft;lt++)if(Lt=ie[lt],w.format!==fi)if(Rt!==null)if(te){if(q)if(w.layerUpdates.size>0){const Nt=Lf(Lt.width,Lt.height,w.format,w.type);for(const Bt of w.layerUpdates){const fe=Lt.data.subarray(Bt*Nt/Lt.data.BYTES_PER_ELEMENT,(Bt+1)*Nt/Lt.data.BYTES_PER_ELEMENT);e.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,lt,0,0,Bt,Lt.width,Lt.height,1,Rt,fe,0,0)}w.clearLayerUpdates()}else e.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,lt,0,0,0,Lt.width,Lt.height,mt.depth,Rt,Lt.data,0,0)}else e.compressedTexImage3D(i.TEXTURE_2D_ARRAY,lt,$t,Lt.width,Lt.height,mt.depth,0,Lt.data,0,0);else console.warn("THREE.WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()");else te?q&&e.texSubImage3D(i.TEXTURE_2D_ARRAY,lt,0,0,0,Lt.width,Lt.height,mt.depth,Rt,jt,Lt.data):e.texImage3D(i.TEXTURE_2D_ARRAY,lt,$t,Lt.width,Lt.height,mt.depth,0,Rt,jt,Lt.data)}else{te&&pe&&e.texStorage2D(i.TEXTURE_2D,Tt,$t,ie[0].width,ie[0].height);for(let lt=0,ft=ie.length;lt<ft;lt++)Lt=ie[lt],w.format!==fi?Rt!==null?te?q&&e.compressedTexSubImage2D(i.TEXTURE_2D,lt,0,0,Lt.width,Lt.height,Rt,Lt.data):e.compressedTexImage2D(i.TEXTURE_2D,lt,$t,Lt.width,Lt.height,0,Lt.data):console.warn("THREE.WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()"):te?q&&e.texSubImage2D(i.TEXTURE_2D,lt,0,0,Lt.width,Lt.height,Rt,jt,Lt.data):e.texImage2D(i.TEXTURE_2D,lt,$t,Lt.width,Lt.height,0,Rt,jt,Lt.data)}else if(w.isDataArrayTexture)if(te){if(pe&&e.texStorage3D(i.TEXTURE_2D_ARRAY,Tt,$t,mt.width,mt.height,mt.depth),q)if(w.layerUpdates.size>0){const lt=Lf(mt.width,mt.height,w.format,w.type);for(const ft of w.layerUpdates){const Nt=mt.data.subarray(ft*lt/mt.data.BYTES_PER_ELEMENT,(ft+1)*lt/mt.data.BYTES_PER_ELEMENT);e.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,ft,mt.width,mt.height,1,Rt,jt,Nt)}w.clearLayerUpdates()}else e.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,0,mt.width,mt.height,mt.depth,Rt,jt,mt.data)}else e.texImage3D(i.TEXTURE_2D_ARRAY,0,$t,mt.width,mt.height,mt.depth,0,Rt,jt,mt.data);else if(w.isData3DTexture)te?(pe&&e.texStorage3D(i.TEXTURE_3D,Tt,$t,mt.width,mt.height,mt.depth),q&&e.texSubImage3D(i.TEXTURE_3D,0,0,0,0,mt.width,mt.height,mt.depth,Rt,jt,mt.data)):e.texImage3D(i.TEXTURE_3D,0,$t,mt.width,mt.height,mt.depth,0,Rt,jt,mt.data);else if(w.isFramebufferTexture){if(pe)if(te)e.texStorage2D(i.TEXTURE_2D,Tt,$t,mt.width,mt.height);else{let lt=mt.width,ft=mt.height;for(let Nt=0;Nt<Tt;Nt++)e.texImage2D(i.TEXTURE_2D,Nt,$t,lt,ft,0,Rt,jt,null),lt>>=1,ft>>=1}}else if(ie.length>0){if(te&&pe){const lt=Xt(ie[0]);e.texStorage2D(i.TEXTURE_2D,Tt,$t,lt.width,lt.height)}for(let lt=0,ft=ie.length;lt<ft;lt++)Lt=ie[lt],te?q&&e.texSubImage2D(i.TEXTURE_2D,lt,0,0,Rt,jt,Lt):e.texImage2D(i.TEXTURE_2D,lt,$t,Rt,jt,Lt);w.generateMipmaps=!1}else if(te){if(pe){const lt=Xt(mt);e.texStorage2D(i.TEXTURE_2D,Tt,$t,lt.width,lt.height)}q&&e.texSubImage2D(i.TEXTURE_2D,0,0,0,Rt,jt,mt)}else e.texImage2D(i.TEXTURE_2D,0,$t,Rt,jt,mt);p(w)&&d(it),It.__version=nt.version,w.onUpdate&&w.onUpdate(w)}L.__version=w.version}function rt(L,w,V){if(w.image.length!==6)return;const it=xt(L,w),ht=w.source;e.bindTexture(i.TEXTURE_CUBE_MAP,L.__webglTexture,i.TEXTURE0+V);const nt=n.get(ht);if(ht.version!==nt.__version||it===!0){e.activeTexture(i.TEXTURE0+V);const It=ye.getPrimaries(ye.workingColorSpace),wt=w.colorSpace===is?null:ye.getPrimaries(w.colorSpace),Ut=w.colorSpace===is||It===wt?i.NONE:i.BROWSER_DEFAULT_WEBGL;i.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,w.flipY),i.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,w.premultiplyAlpha),i.pixelStorei(i.UNPACK_ALIGNMENT,w.unpackAlignment),i.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,Ut);const re=w.isCompressedTexture||w.image[0].isCompressedTexture,mt=w.image[0]&&w.image[0].isDataTexture,Rt=[];for(let ft=0;ft<6;ft++)!re&&!mt?Rt[ft]=M(w.image[ft],!0,s.maxCubemapSize):Rt[ft]=mt?w.image[ft].image:w.image[ft],Rt[ft]=Et(w,Rt[ft]);const jt=Rt[0],$t=r.convert(w.format,w.colorSpace),Lt=r.convert(w.type),ie=C(w.internalFormat,$t,Lt,w.colorSpace),te=w.isVideoTexture!==!0,pe=nt.__version===void 0||it===!0,q=ht.dataReady;let Tt=R(w,jt);gt(i.TEXTURE_CUBE_MAP,w);let lt;if(re){te&&pe&&e.texStorage2D(i.TEXTURE_CUBE_MAP,Tt,ie,jt.width,jt.height);for(let ft=0;ft<6;ft++){lt=Rt[ft].mipmaps;for(let Nt=0;Nt<lt.length;Nt++){const Bt=lt[Nt];w.format!==fi?$t!==null?te?q&&e.compressedTexSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ft,Nt,0,0,Bt.width,Bt.height,$t,Bt.data):e.compressedTexImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ft,Nt,ie,Bt.width,Bt.height,0,Bt.data):console.warn("THREE.WebGLRenderer: Attempt to load unsupported compressed texture format in .setTextureCube()"):te?q&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ft,Nt,0,0,Bt.width,Bt.height,$t,Lt,Bt.data):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ft,Nt,ie,Bt.width,Bt.height,0,$t,Lt,Bt.data)}}}else{if(lt=w.mipmaps,te&&pe){lt.length>0&&Tt++;const ft=Xt(Rt[0]);e.texStorage2D(i.TEXTURE_CUBE_MAP,Tt,ie,ft.width,ft.height)}for(let ft=0;ft<6;ft++)if(mt){te?q&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ft,0,0,0,Rt[ft].width,Rt[ft].height,$t,Lt,Rt[ft].data):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ft,0,ie,Rt[ft].width,Rt[ft].height,0,$t,Lt,Rt[ft].data);for(let Nt=0;Nt<lt.length;Nt++){const fe=lt[Nt].image[ft].image;te?q&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ft,Nt+1,0,0,fe.width,fe.height,$t,Lt,fe.data):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ft,Nt+1,ie,fe.width,fe.height,0,$t,Lt,fe.data)}}else{te?q&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ft,0,0,0,$t,Lt,Rt[ft]):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ft,0,ie,$t,Lt,Rt[ft]);for(let Nt=0;Nt<lt.length;Nt++){const Bt=lt[Nt];te?q&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ft,Nt+1,0,0,$t,Lt,Bt.image[ft]):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ft,Nt+1,ie,$t,Lt,Bt.image[ft])}}}p(w)&&d(i.TEXTURE_CUBE_MAP),nt.__version=ht.version,w.onUpdate&&w.onUpdate(w)}L.__version=w.version}function pt(L,w,V,it,ht,nt){const It=r.convert(V.format,V.colorSpace),wt=r.convert(V.type),Ut=C(V.internalFormat,It,wt,V.colorSpace);if(!n.get(w).__hasExternalTextures){const mt=Math.max(1,w.width>>nt),Rt=Math.max(1,w.height>>nt);ht===i.TEXTURE_3D||ht===i.TEXTURE_2D_ARRAY?e.texImage3D(ht,nt,Ut,mt,Rt,w.depth,0,It,wt,null):e.texImage2D(ht,nt,Ut,mt,Rt,0,It,wt,null)}e.bindFramebuffer(i.FRAMEBUFFER,L),Ht(w)?o.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,it,ht,n.get(V).__webglTexture,0,Mt(w)):(ht===i.TEXTURE_2D||ht>=i.TEXTURE_CUBE_MAP_POSITIVE_X&&ht<=i.TEXTURE_CUBE_MAP_NEGATIVE_Z)&&i.framebufferTexture2D(i.FRAMEBUFFER,it,ht,n.get(V).__webglTexture,nt),e.bindFramebuffer(i.FRAMEBUFFER,null)}function Dt(L,w,V){if(i.bindRenderbuffer(i.RENDERBUFFER,L),w.depthBuffer){const it=w.depthTexture,ht=it&&it.isDepthTexture?it.type:null,nt=b(w.stencilBuffer,ht),It=w.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,wt=Mt(w);Ht(w)?o.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,wt,nt,w.width,w.height):V?i.renderbufferStorageMultisample(i.RENDERBUFFER,wt,nt,w.width,w.height):i.renderbufferStorage(i.RENDERBUFFER,nt,w.width,w.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,It,i.RENDERBUFFER,L)}else{const it=w.textures;for(let ht=0;ht<it.length;ht++){const nt=it[ht],It=r.convert(nt.format,nt.colorSpace),wt=r.convert(nt.type),Ut=C(nt.internalFormat,It,wt,nt.colorSpace),re=Mt(w);V&&Ht(w)===!1?i.renderbufferStorageMultisample(i.RENDERBUFFER,re,Ut,w.width,w.height):Ht(w)?o.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,re,Ut,w.width,w.height):i.renderbufferStorage(i.RENDERBUFFER,Ut,w.width,w.height)}}i.bindRenderbuffer(i.RENDERBUFFER,null)}function St(L,w){if(w&&w.isWebGLCubeRenderTarget)throw new Error("Depth Texture with cube render targets is not supported");if(e.bindFramebuffer(i.FRAMEBUFFER,L),!(w.depthTexture&&w.depthTexture.isDepthTexture))throw new Error("renderTarget.depthTexture must be an instance of THREE.DepthTexture");(!n.get(w.depthTexture).__webglTexture||w.depthTexture.image.width!==w.width||w.depthTexture.image.height!==w.height)&&(w.depthTexture.image.width=w.width,w.depthTexture.image.height=w.height,w.depthTexture.needsUpdate=!0),F(w.depthTexture,0);const it=n.get(w.depthTexture).__webglTexture,ht=Mt(w);if(w.depthTexture.format===Lr)Ht(w)?o.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,i.DEPTH_ATTACHMENT,i.TEXTURE_2D,it,0,ht):i.framebufferTexture2D(i.FRAMEBUFFER,i.DEPTH_ATTACHMENT,i.TEXTURE_2D,it,0);else if(w.depthTexture.format===Fr)Ht(w)?o.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,i.DEPTH_STENCIL_ATTACHMENT,i.TEXTURE_2D,it,0,ht):i.framebufferTexture2D(i.FRAMEBUFFER,i.DEPTH_STENCIL_ATTACHMENT,i.TEXTURE_2D,it,0);else throw new Error("Unknown depthTexture format")}function Z(L){const w=n.get(L),V=L.isWebGLCubeRenderTarget===!0;if(w.__boundDepthTexture!==L.depthTexture){const it=L.depthTexture;if(w.__depthDisposeCallback&&w.__depthDisposeCallback(),it){const ht=()=>{delete w.__boundDepthTexture,delete w.__depthDisposeCallback,it.removeEventListener("dispose",ht)};it.addEventListener("dispose",ht),w.__depthDisposeCallback=ht}w.__boundDepthTexture=it}if(L.depthTexture&&!w.__autoAllocateDepthBuffer){if(V)throw new Error("target.depthTexture not supported in Cube render targets");St(w.__webglFramebuffer,L)}else if(V){w.__webglDepthbuffer=[];for(let it=0;it<6;it++)if(e.bindFramebuffer(i.FRAMEBUFFER,w.__webglFramebuffer[it]),w.__webglDepthbuffer[it]===void 0)w.__webglDepthbuffer[it]=i.createRenderbuffer(),Dt(w.__webglDepthbuffer[it],L,!1);else{const ht=L.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,nt=w.__webglDepthbuffer[it];i.bindRenderbuffer(i.RENDERBUFFER,nt),i.framebufferRenderbuffer(i.FRAMEBUFFER,ht,i.RENDERBUFFER,nt)}}else if(e.bindFramebuffer(i.FRAMEBUFFER,w.__webglFramebuffer),w.__webglDepthbuffer===void 0)w.__webglDepthbuffer=i.createRenderbuffer(),Dt(w.__webglDepthbuffer,L,!1);else{const it=L.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,ht=w.__webglDepthbuffer;i.bindRenderbuffer(i.RENDERBUFFER,ht),i.framebufferRenderbuffer(i.FRAMEBUFFER,it,i.RENDERBUFFER,ht)}e.bindFramebuffer(i.FRAMEBUFFER,null)}function J(L,w,V){const it=n.get(L);w!==void 0&&pt(it.__webglFramebuffer,L,L.texture,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,0),V!==void 0&&Z(L)}function Y(L){const w=L.texture,V=n.get(L),it=n.get(w);L.addEventListener("dispose",A);const ht=L.textures,nt=L.isWebGLCubeRenderTarget===!0,It=ht.length>1;if(It||(it.__webglTexture===void 0&&(it.__webglTexture=i.createTexture()),it.__version=w.version,a.memory.textures++),nt){V.__webglFramebuffer=[];for(let wt=0;wt<6;wt++)if(w.mipmaps&&w.mipmaps.length>0){V.__webglFramebuffer[wt]=[];for(let Ut=0;Ut<w.mipmaps.length;Ut++)V.__webglFramebuffer[wt][Ut]=i.createFramebuffer()}else V.__webglFramebuffer[wt]=i.createFramebuffer()}else{if(w.mipmaps&&w.mipmaps.length>0){V.__webglFramebuffer=[];for(let wt=0;wt<w.mipmaps.length;wt++)V.__webglFramebuffer[wt]=i.createFramebuffer()}else V.__webglFramebuffer=i.createFramebuffer();if(It)for(let wt=0,Ut=ht.length;wt<Ut;wt++){const re=n.get(ht[wt]);re.__webglTexture===void 0&&(re.__webglTexture=i.createTexture(),a.memory.textures++)}if(L.samples>0&&Ht(L)===!1){V.__webglMultisampledFramebuffer=i.createFramebuffer(),V.__webglColorRenderbuffer=[],e.bindFramebuffer(i.FRAMEBUFFER,V.__webglMultisampledFramebuffer);for(let wt=0;wt<ht.length;wt++){const Ut=ht[wt];V.__webglColorRenderbuffer[wt]=i.createRenderbuffer(),i.bindRenderbuffer(i.RENDERBUFFER,V.__webglColorRenderbuffer[wt]);const re=r.convert(Ut.format,Ut.colorSpace),mt=r.convert(Ut.type),Rt=C(Ut.internalFormat,re,mt,Ut.colorSpace,L.isXRRenderTarget===!0),jt=Mt(L);i.renderbufferStorageMultisample(i.RENDERBUFFER,jt,Rt,L.width,L.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+wt,i.RENDERBUFFER,V.__webglColorRenderbuffer[wt])}i.bindRenderbuffer(i.RENDERBUFFER,null),L.depthBuffer&&(V.__webglDepthRenderbuffer=i.createRenderbuffer(),Dt(V.__webglDepthRenderbuffer,L,!0)),e.bindFramebuffer(i.FRAMEBUFFER,null)}}if(nt){e.bindTexture(i.TEXTURE_CUBE_MAP,it.__webglTexture),gt(i.TEXTURE_CUBE_MAP,w);for(let wt=0;wt<6;wt++)if(w.mipmaps&&w.mipmaps.length>0)for(let Ut=0;Ut<w.mipmaps.length;Ut++)pt(V.__webglFramebuffer[wt][Ut],L,w,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+wt,Ut);else pt(V.__webglFramebuffer[wt],L,w,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+wt,0);p(w)&&d(i.TEXTURE_CUBE_MAP),e.unbindTexture()}else if(It){for(let wt=0,Ut=ht.length;wt<Ut;wt++){const re=ht[wt],mt=n.get(re);e.bindTexture(i.TEXTURE_2D,mt.__webglTexture),gt(i.TEXTURE_2D,re),pt(V.__webglFramebuffer,L,re,i.COLOR_ATTACHMENT0+wt,i.TEXTURE_2D,0),p(re)&&d(i.TEXTURE_2D)}e.unbindTexture()}else{let wt=i.TEXTURE_2D;if((L.isWebGL3DRenderTarget||L.isWebGLArrayRenderTarget)&&(wt=L.isWebGL3DRenderTarget?i.TEXTURE_3D:i.TEXTURE_2D_ARRAY),e.bindTexture(wt,it.__webglTexture),gt(wt,w),w.mipmaps&&w.mipmaps.length>0)for(let Ut=0;Ut<w.mipmaps.length;Ut++)pt(V.__webglFramebuffer[Ut],L,w,i.COLOR_ATTACHMENT0,wt,Ut);else pt(V.__webglFramebuffer,L,w,i.COLOR_ATTACHMENT0,wt,0);p(w)&&d(wt),e.unbindTexture()}L.depthBuffer&&Z(L)}function at(L){const w=L.textures;for(let V=0,it=w.length;V<it;V++){const ht=w[V];if(p(ht)){const nt=L.isWebGLCubeRenderTarget?i.TEXTURE_CUBE_MAP:i.TEXTURE_2D,It=n.get(ht).__webglTexture;e.bindTexture(nt,It),d(nt),e.unbindTexture()}}}const ot=[],I=[];function Ot(L){if(L.samples>0){if(Ht(L)===!1){const w=L.textures,V=L.width,it=L.height;let ht=i.COLOR_BUFFER_BIT;const nt=L.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,It=n.get(L),wt=w.length>1;if(wt)for(let Ut=0;Ut<w.length;Ut++)e.bindFramebuffer(i.FRAMEBUFFER,It.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+Ut,i.RENDERBUFFER,null),e.bindFramebuffer(i.FRAMEBUFFER,It.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+Ut,i.TEXTURE_2D,null,0);e.bindFramebuffer(i.READ_FRAMEBUFFER,It.__webglMultisampledFramebuffer),e.bindFramebuffer(i.DRAW_FRAMEBUFFER,It.__webglFramebuffer);for(let Ut=0;Ut<w.length;Ut++){if(L.resolveDepthBuffer&&(L.depthBuffer&&(ht|=i.DEPTH_BUFFER_BIT),L.stencilBuffer&&L.resolveStencilBuffer&&(ht|=i.STENCIL_BUFFER_BIT)),wt){i.framebufferRenderbuffer(i.READ_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.RENDERBUFFER,It.__webglColorRenderbuffer[Ut]);const re=n.get(w[Ut]).__webglTexture;i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,re,0)}i.blitFramebuffer(0,0,V,it,0,0,V,it,ht,i.NEAREST),l===!0&&(ot.length=0,I.length=0,ot.push(i.COLOR_ATTACHMENT0+Ut),L.depthBuffer&&L.resolveDepthBuffer===!1&&(ot.push(nt),I.push(nt),i.invalidateFramebuffer(i.DRAW_FRAMEBUFFER,I)),i.invalidateFramebuffer(i.READ_FRAMEBUFFER,ot))}if(e.bindFramebuffer(i.READ_FRAMEBUFFER,null),e.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),wt)for(let Ut=0;Ut<w.length;Ut++){e.bindFramebuffer(i.FRAMEBUFFER,It.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+Ut,i.RENDERBUFFER,It.__webglColorRenderbuffer[Ut]);const re=n.get(w[Ut]).__webglTexture;e.bindFramebuffer(i.FRAMEBUFFER,It.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+Ut,i.TEXTURE_2D,re,0)}e.bindFramebuffer(i.DRAW_FRAMEBUFFER,It.__webglMultisampledFramebuffer)}else if(L.depthBuffer&&L.resolveDepthBuffer===!1&&l){const w=L.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;i.invalidateFramebuffer(i.DRAW_FRAMEBUFFER,[w])}}}function Mt(L){return Math.min(s.maxSamples,L.samples)}function Ht(L){const w=n.get(L);return L.samples>0&&t.has("WEBGL_multisampled_render_to_texture")===!0&&w.__useRenderToTexture!==!1}function At(L){const w=a.render.frame;u.get(L)!==w&&(u.set(L,w),L.update())}function Et(L,w){const V=L.colorSpace,it=L.format,ht=L.type;return L.isCompressedTexture===!0||L.isVideoTexture===!0||V!==ps&&V!==is&&(ye.getTransfer(V)===Fe?(it!==fi||ht!==Vi)&&console.warn("THREE.WebGLTextures: sRGB encoded textures have to use RGBAFormat and UnsignedByteType."):console.error("THREE.WebGLTextures: Unsupported texture color space:",V)),w}function Xt(L){return typeof HTMLImageElement<"u"&&L instanceof HTMLImageElement?(c.width=L.naturalWidth||L.width,c.height=L.naturalHeight||L.height):typeof VideoFrame<"u"&&L instanceof VideoFrame?(c.width=L.displayWidth,c.height=L.displayHeight):(c.width=L.width,c.height=L.height),c}this.allocateTextureUnit=E,this.resetTextureUnits=m,this.setTexture2D=F,this.setTexture2DArray=B,this.setTexture3D=G,this.setTextureCube=$,this.rebindTextures=J,this.setupRenderTarget=Y,this.updateRenderTargetMipmap=at,this.updateMultisampleRenderTarget=Ot,this.setupDepthRenderbuffer=Z,this.setupFrameBufferTexture=pt,this.useMultisampledRTT=Ht}function Ly(i,t){function e(n,s=is){let r;const a=ye.getTransfer(s);if(n===Vi)return i.UNSIGNED_BYTE;if(n===Dh)return i.UNSIGNED_SHORT_4_4_4_4;if(n===Ih)return i.UNSIGNED_SHORT_5_5_5_1;if(n===ep)return i.UNSIGNED_INT_5_9_9_9_REV;if(n===Qd)return i.BYTE;if(n===tp)return i.SHORT;if(n===Aa)return i.UNSIGNED_SHORT;if(n===Lh)return i.INT;if(n===Os)return i.UNSIGNED_INT;if(n===Bi)return i.FLOAT;if(n===Pa)return i.HALF_FLOAT;if(n===np)return i.ALPHA;if(n===ip)return i.RGB;if(n===fi)return i.RGBA;if(n===sp)return i.LUMINANCE;if(n===rp)return i.LUMINANCE_ALPHA;if(n===Lr)return i.DEPTH_COMPONENT;if(n===Fr)return i.DEPTH_STENCIL;if(n===ap)return i.RED;if(n===Uh)return i.RED_INTEGER;if(n===op)return i.RG;if(n===Nh)return i.RG_INTEGER;if(n===kh)return i.RGBA_INTEGER;if(n===Ro||n===Co||n===Po||n===Lo)if(a===Fe)if(r=t.get("WEBGL_compressed_texture_s3tc_srgb"),r!==null){if(n===Ro)return r.COMPRESSED_SRGB_S3TC_DXT1_EXT;if(n===Co)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT;if(n===Po)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT;if(n===Lo)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT}else return null;else if(r=t.get("WEBGL_compressed_texture_s3tc"),r!==null){if(n===Ro)return r.COMPRESSED_RGB_S3TC_DXT1_EXT;if(n===Co)return r.COMPRESSED_RGBA_S3TC_DXT1_EXT;if(n===Po)return r.COMPRESSED_RGBA_S3TC_DXT3_EXT;if(n===Lo)return r.COMPRESSED_RGBA_S3TC_DXT5_EXT}else return null;if(n===Bc||n===zc||n===Hc||n===Gc)if(r=t.get("WEBGL_compressed_texture_pvrtc"),r!==null){if(n===Bc)return r.COMPRESSED_RGB_PVRTC_4BPPV1_IMG;if(n===zc)return r.COMPRESSED_RGB_PVRTC_2BPPV1_IMG;if(n===Hc)return r.COMPRESSED_RGBA_PVRTC_4BPPV1_IMG;if(n===Gc)return r.COMPRESSED_RGBA_PVRTC_2BPPV1_IMG}else return null;if(n===Vc||n===Wc||n===Xc)if(r=t.get("WEBGL_compressed_texture_etc"),r!==null){if(n===Vc||n===Wc)return a===Fe?r.COMPRESSED_SRGB8_ETC2:r.COMPRESSED_RGB8_ETC2;if(n===Xc)return a===Fe?r.COMPRESSED_SRGB8_ALPHA8_ETC2_EAC:r.COMPRESSED_RGBA8_ETC2_EAC}else return null;if(n===qc||n===Yc||n===jc||n===Kc||n===$c||n===Zc||n===Jc||n===Qc||n===th||n===eh||n===nh||n===ih||n===sh||n===rh)if(r=t.get("WEBGL_compressed_texture_astc"),r!==null){if(n===qc)return a===Fe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_4x4_KHR:r.COMPRESSED_RGBA_ASTC_4x4_KHR;if(n===Yc)return a===Fe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x4_KHR:r.COMPRESSED_RGBA_ASTC_5x4_KHR;if(n===jc)return a===Fe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x5_KHR:r.COMPRESSED_RGBA_ASTC_5x5_KHR;if(n===Kc)return a===Fe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x5_KHR:r.COMPRESSED_RGBA_ASTC_6x5_KHR;if(n===$c)return a===Fe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x6_KHR:r.COMPRESSED_RGBA_ASTC_6x6_KHR;if(n===Zc)return a===Fe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x5_KHR:r.COMPRESSED_RGBA_ASTC_8x5_KHR;if(n===Jc)return a===Fe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x6_KHR:r.COMPRESSED_RGBA_ASTC_8x6_KHR;if(n===Qc)return a===Fe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x8_KHR:r.COMPRESSED_RGBA_ASTC_8x8_KHR;if(n===th)return a===Fe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x5_KHR:r.COMPRESSED_RGBA_ASTC_10x5_KHR;if(n===eh)return a===Fe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x6_KHR:r.COMPRESSED_RGBA_ASTC_10x6_KHR;if(n===nh)return a===Fe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x8_KHR:r.COMPRESSED_RGBA_ASTC_10x8_KHR;if(n===ih)return a===Fe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x10_KHR:r.COMPRESSED_RGBA_ASTC_10x10_KHR;if(n===sh)return a===Fe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x10_KHR:r.COMPRESSED_RGBA_ASTC_12x10_KHR;if(n===rh)return a===Fe?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x12_KHR:r.COMPRESSED_RGBA_ASTC_12x12_KHR}else return null;if(n===Do||n===ah||n===oh)if(r=t.get("EXT_texture_compression_bptc"),r!==null){if(n===Do)return a===Fe?r.COMPRESSED_SRGB_ALPHA_BPTC_UNORM_EXT:r.COMPRESSED_RGBA_BPTC_UNORM_EXT;if(n===ah)return r.COMPRESSED_RGB_BPTC_SIGNED_FLOAT_EXT;if(n===oh)return r.COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_EXT}else return null;if(n===lp||n===lh||n===ch||n===hh)if(r=t.get("EXT_texture_compression_rgtc"),r!==null){if(n===Do)return r.COMPRESSED_RED_RGTC1_EXT;if(n===lh)return r.COMPRESSED_SIGNED_RED_RGTC1_EXT;if(n===ch)return r.COMPRESSED_RED_GREEN_RGTC2_EXT;if(n===hh)return r.COMPRESSED_SIGNED_RED_GREEN_RGTC2_EXT}else return null;return n===Or?i.UNSIGNED_INT_24_8:i[n]!==void 0?i[n]:null}return{convert:e}}class Dy extends Qn{constructor(t=[]){super(),this.isArrayCamera=!0,this.cameras=t}}class di extends an{constructor(){super(),this.isGroup=!0,this.type="Group"}}const Iy={type:"move"};class sc{constructor(){this._targetRay=null,this._grip=null,this._hand=null}getHandSpace(){return this._hand===null&&(this._hand=new di,this._hand.matrixAutoUpdate=!1,this._hand.visible=!1,this._hand.joints={},this._hand.inputState={pinching:!1}),this._hand}getTargetRaySpace(){return this._targetRay===null&&(this._targetRay=new di,this._targetRay.matrixAutoUpdate=!1,this._targetRay.visible=!1,this._targetRay.hasLinearVelocity=!1,this._targetRay.linearVelocity=new j,this._targetRay.hasAngularVelocity=!1,this._targetRay.angularVelocity=new j),this._targetRay}getGripSpace(){return this._grip===null&&(this._grip=new di,this._grip.matrixAutoUpdate=!1,this._grip.visible=!1,this._grip.hasLinearVelocity=!1,this._grip.linearVelocity=new j,this._grip.hasAngularVelocity=!1,this._grip.angularVelocity=new j),this._grip}dispatchEvent(t){return this._targetRay!==null&&this._targetRay.dispatchEvent(t),this._grip!==null&&this._grip.dispatchEvent(t),this._hand!==null&&this._hand.dispatchEvent(t),this}connect(t){if(t&&t.hand){const e=this._hand;if(e)for(const n of t.hand.values())this._getHandJoint(e,n)}return this.dispatchEvent({type:"connected",data:t}),this}disconnect(t){return this.dispatchEvent({type:"disconnected",data:t}),this._targetRay!==null&&(this._targetRay.visible=!1),this._grip!==null&&(this._grip.visible=!1),this._hand!==null&&(this._hand.visible=!1),this}update(t,e,n){let s=null,r=null,a=null;const o=this._targetRay,l=this._grip,c=this._hand;if(t&&e.session.visibilityState!=="visible-blurred"){if(c&&t.hand){a=!0;for(const M of t.hand.values()){const p=e.getJointPose(M,n),d=this._getHandJoint(c,M);p!==null&&(d.matrix.fromArray(p.transform.matrix),d.matrix.decompose(d.position,d.rotation,d.scale),d.matrixWorldNeedsUpdate=!0,d.jointRadius=p.radius),d.visible=p!==null}const u=c.joints["index-finger-tip"],f=c.joints["thumb-tip"],h=u.position.distanceTo(f.position),_=.02,x=.005;c.inputState.pinching&&h>_+x?(c.inputState.pinching=!1,this.dispatchEvent({type:"pinchend",handedness:t.handedness,target:this})):!c.inputState.pinching&&h<=_-x&&(c.inputState.pinching=!0,this.dispatchEvent({type:"pinchstart",handedness:t.handedness,target:this}))}else l!==null&&t.gripSpace&&(r=e.getPose(t.gripSpace,n),r!==null&&(l.matrix.fromArray(r.transform.matrix),l.matrix.decompose(l.position,l.rotation,l.scale),l.matrixWorldNeedsUpdate=!0,r.linearVelocity?(l.hasLinearVelocity=!0,l.linearVelocity.copy(r.linearVelocity)):l.hasLinearVelocity=!1,r.angularVelocity?(l.hasAngularVelocity=!0,l.angularVelocity.copy(r.angularVelocity)):l.hasAngularVelocity=!1));o!==null&&(s=e.getPose(t.targetRaySpace,n),s===null&&r!==null&&(s=r),s!==null&&(o.matrix.fromArray(s.transform.matrix),o.matrix.decompose(o.position,o.rotation,o.scale),o.matrixWorldNeedsUpdate=!0,s.linearVelocity?(o.hasLinearVelocity=!0,o.linearVelocity.copy(s.linearVelocity)):o.hasLinearVelocity=!1,s.angularVelocity?(o.hasAngularVelocity=!0,o.angularVelocity.copy(s.angularVelocity)):o.hasAngularVelocity=!1,this.dispatchEvent(Iy)))}return o!==null&&(o.visible=s!==null),l!==null&&(l.visible=r!==null),c!==null&&(c.visible=a!==null),this}_getHandJoint(t,e){if(t.joints[e.jointName]===void 0){const n=new di;n.matrixAutoUpdate=!1,n.visible=!1,t.joints[e.jointName]=n,t.add(n)}return t.joints[e.jointName]}}const Uy=`
void main() {

	gl_Position = vec4( position, 1.0 );

}`,Ny=`
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

}`;class ky{constructor(){this.texture=null,this.mesh=null,this.depthNear=0,this.depthFar=0}init(t,e,n){if(this.texture===null){const s=new Ln,r=t.properties.get(s);r.__webglTexture=e.texture,(e.depthNear!=n.depthNear||e.depthFar!=n.depthFar)&&(this.depthNear=e.depthNear,this.depthFar=e.depthFar),this.texture=s}}getMesh(t){if(this.texture!==null&&this.mesh===null){const e=t.cameras[0].viewport,n=new fs({vertexShader:Uy,fragmentShader:Ny,uniforms:{depthColor:{value:this.texture},depthWidth:{value:e.z},depthHeight:{value:e.w}}});this.mesh=new rn(new nl(20,20),n)}return this.mesh}reset(){this.texture=null,this.mesh=null}getDepthTexture(){return this.texture}}class Oy extends Hs{constructor(t,e){super();const n=this;let s=null,r=1,a=null,o="local-floor",l=1,c=null,u=null,f=null,h=null,_=null,x=null;const M=new ky,p=e.getContextAttributes();let d=null,C=null;const b=[],R=[],D=new Qt;let A=null;const y=new Qn;y.layers.enable(1),y.viewport=new je;const P=new Qn;P.layers.enable(2),P.viewport=new je;const O=[y,P],g=new Dy;g.layers.enable(1),g.layers.enable(2);let m=null,E=null;this.cameraAutoUpdate=!0,this.enabled=!1,this.isPresenting=!1,this.getController=function(rt){let pt=b[rt];return pt===void 0&&(pt=new sc,b[rt]=pt),pt.getTargetRaySpace()},this.getControllerGrip=function(rt){let pt=b[rt];return pt===void 0&&(pt=new sc,b[rt]=pt),pt.getGripSpace()},this.getHand=function(rt){let pt=b[rt];return pt===void 0&&(pt=new sc,b[rt]=pt),pt.getHandSpace()};function N(rt){const pt=R.indexOf(rt.inputSource);if(pt===-1)return;const Dt=b[pt];Dt!==void 0&&(Dt.update(rt.inputSource,rt.frame,c||a),Dt.dispatchEvent({type:rt.type,data:rt.inputSource}))}function F(){s.removeEventListener("select",N),s.removeEventListener("selectstart",N),s.removeEventListener("selectend",N),s.removeEventListener("squeeze",N),s.removeEventListener("squeezestart",N),s.removeEventListener("squeezeend",N),s.removeEventListener("end",F),s.removeEventListener("inputsourceschange",B);for(let rt=0;rt<b.length;rt++){const pt=R[rt];pt!==null&&(R[rt]=null,b[rt].disconnect(pt))}m=null,E=null,M.reset(),t.setRenderTarget(d),_=null,h=null,f=null,s=null,C=null,Vt.stop(),n.isPresenting=!1,t.setPixelRatio(A),t.setSize(D.width,D.height,!1),n.dispatchEvent({type:"sessionend"})}this.setFramebufferScaleFactor=function(rt){r=rt,n.isPresenting===!0&&console.warn("THREE.WebXRManager: Cannot change framebuffer scale while presenting.")},this.setReferenceSpaceType=function(rt){o=rt,n.isPresenting===!0&&console.warn("THREE.WebXRManager: Cannot change reference space type while presenting.")},this.getReferenceSpace=function(){return c||a},this.setReferenceSpace=function(rt){c=rt},this.getBaseLayer=function(){return h!==null?h:_},this.getBinding=function(){return f},this.getFrame=function(){return x},this.getSession=function(){return s},this.setSession=async function(rt){if(s=rt,s!==null){if(d=t.getRenderTarget(),s.addEventListener("select",N),s.addEventListener("selectstart",N),s.addEventListener("selectend",N),s.addEventListener("squeeze",N),s.addEventListener("squeezestart",N),s.addEventListener("squeezeend",N),s.addEventListener("end",F),s.addEventListener("inputsourceschange",B),p.xrCompatible!==!0&&await e.makeXRCompatible(),A=t.getPixelRatio(),t.getSize(D),s.renderState.layers===void 0){const pt={antialias:p.antialias,alpha:!0,depth:p.depth,stencil:p.stencil,framebufferScaleFactor:r};_=new XRWebGLLayer(s,e,pt),s.updateRenderState({baseLayer:_}),t.setPixelRatio(1),t.setSize(_.framebufferWidth,_.framebufferHeight,!1),C=new Fs(_.framebufferWidth,_.framebufferHeight,{format:fi,type:Vi,colorSpace:t.outputColorSpace,stencilBuffer:p.stencil})}else{let pt=null,Dt=null,St=null;p.depth&&(St=p.stencil?e.DEPTH24_STENCIL8:e.DEPTH_COMPONENT24,pt=p.stencil?Fr:Lr,Dt=p.stencil?Or:Os);const Z={colorFormat:e.RGBA8,depthFormat:St,scaleFactor:r};f=new XRWebGLBinding(s,e),h=f.createProjectionLayer(Z),s.updateRenderState({layers:[h]}),t.setPixelRatio(1),t.setSize(h.textureWidth,h.textureHeight,!1),C=new Fs(h.textureWidth,h.textureHeight,{format:fi,type:Vi,depthTexture:new Ep(h.textureWidth,h.textureHeight,Dt,void 0,void 0,void 0,void 0,void 0,void 0,pt),stencilBuffer:p.stencil,colorSpace:t.outputColorSpace,samples:p.antialias?4:0,resolveDepthBuffer:h.ignoreDepthValues===!1})}C.isXRRenderTarget=!0,this.setFoveation(l),c=null,a=await s.requestReferenceSpace(o),Vt.setContext(s),Vt.start(),n.isPresenting=!0,n.dispatchEvent({type:"sessionstart"})}},this.getEnvironmentBlendMode=function(){if(s!==null)return s.environmentBlendMode},this.getDepthTexture=function(){return M.getDepthTexture()};function B(rt){for(let pt=0;pt<rt.removed.length;pt++){const Dt=rt.removed[pt],St=R.indexOf(Dt);St>=0&&(R[St]=null,b[St].disconnect(Dt))}for(let pt=0;pt<rt.added.length;pt++){const Dt=rt.added[pt];let St=R.indexOf(Dt);if(St===-1){for(let J=0;J<b.length;J++)if(J>=R.length){R.push(Dt),St=J;break}else if(R[J]===null){R[J]=Dt,St=J;break}if(St===-1)break}const Z=b[St];Z&&Z.connect(Dt)}}const G=new j,$=new j;function Q(rt,pt,Dt){G.setFromMatrixPosition(pt.matrixWorld),$.setFromMatrixPosition(Dt.matrixWorld);const St=G.distanceTo($),Z=pt.projectionMatrix.elements,J=Dt.projectionMatrix.elements,Y=Z[14]/(Z[10]-1),at=Z[14]/(Z[10]+1),ot=(Z[9]+1)/Z[5],I=(Z[9]-1)/Z[5],Ot=(Z[8]-1)/Z[0],Mt=(J[8]+1)/J[0],Ht=Y*Ot,At=Y*Mt,Et=St/(-Ot+Mt),Xt=Et*-Ot;if(pt.matrixWorld.decompose(rt.position,rt.quaternion,rt.scale),rt.translateX(Xt),rt.translateZ(Et),rt.matrixWorld.compose(rt.position,rt.quaternion,rt.scale),rt.matrixWorldInverse.copy(rt.matrixWorld).invert(),Z[10]===-1)rt.projectionMatrix.copy(pt.projectionMatrix),rt.projectionMatrixInverse.copy(pt.projectionMatrixInverse);else{const L=Y+Et,w=at+Et,V=Ht-Xt,it=At+(St-Xt),ht=ot*at/w*L,nt=I*at/w*L;rt.projectionMatrix.makePerspective(V,it,ht,nt,L,w),rt.projectionMatrixInverse.copy(rt.projectionMatrix).invert()}}function dt(rt,pt){pt===null?rt.matrixWorld.copy(rt.matrix):rt.matrixWorld.multiplyMatrices(pt.matrixWorld,rt.matrix),rt.matrixWorldInverse.copy(rt.matrixWorld).invert()}this.updateCamera=function(rt){if(s===null)return;let pt=rt.near,Dt=rt.far;M.texture!==null&&(M.depthNear>0&&(pt=M.depthNear),M.depthFar>0&&(Dt=M.depthFar)),g.near=P.near=y.near=pt,g.far=P.far=y.far=Dt,(m!==g.near||E!==g.far)&&(s.updateRenderState({depthNear:g.near,depthFar:g.far}),m=g.near,E=g.far);const St=rt.parent,Z=g.cameras;dt(g,St);for(let J=0;J<Z.length;J++)dt(Z[J],St);Z.length===2?Q(g,y,P):g.projectionMatrix.copy(y.projectionMatrix),ct(rt,g,St)};function ct(rt,pt,Dt){Dt===null?rt.matrix.copy(pt.matrixWorld):(rt.matrix.copy(Dt.matrixWorld),rt.matrix.invert(),rt.matrix.multiply(pt.matrixWorld)),rt.matrix.decompose(rt.position,rt.quaternion,rt.scale),rt.updateMatrixWorld(!0),rt.projectionMatrix.copy(pt.projectionMatrix),rt.projectionMatrixInverse.copy(pt.projectionMatrixInverse),rt.isPerspectiveCamera&&(rt.fov=fh*2*Math.atan(1/rt.projectionMatrix.elements[5]),rt.zoom=1)}this.getCamera=function(){return g},this.getFoveation=function(){if(!(h===null&&_===null))return l},this.setFoveation=function(rt){l=rt,h!==null&&(h.fixedFoveation=rt),_!==null&&_.fixedFoveation!==void 0&&(_.fixedFoveation=rt)},this.hasDepthSensing=function(){return M.texture!==null},this.getDepthSensingMesh=function(){return M.getMesh(g)};let gt=null;function xt(rt,pt){if(u=pt.getViewerPose(c||a),x=pt,u!==null){const Dt=u.views;_!==null&&(t.setRenderTargetFramebuffer(C,_.framebuffer),t.setRenderTarget(C));let St=!1;Dt.length!==g.cameras.length&&(g.cameras.length=0,St=!0);for(let J=0;J<Dt.length;J++){const Y=Dt[J];let at=null;if(_!==null)at=_.getViewport(Y);else{const I=f.getViewSubImage(h,Y);at=I.viewport,J===0&&(t.setRenderTargetTextures(C,I.colorTexture,h.ignoreDepthValues?void 0:I.depthStencilTexture),t.setRenderTarget(C))}let ot=O[J];ot===void 0&&(ot=new Qn,ot.layers.enable(J),ot.viewport=new je,O[J]=ot),ot.matrix.fromArray(Y.transform.matrix),ot.matrix.decompose(ot.position,ot.quaternion,ot.scale),ot.projectionMatrix.fromArray(Y.projectionMatrix),ot.projectionMatrixInverse.copy(ot.projectionMatrix).invert(),ot.viewport.set(at.x,at.y,at.width,at.height),J===0&&(g.matrix.copy(ot.matrix),g.matrix.decompose(g.position,g.quaternion,g.scale)),St===!0&&g.cameras.push(ot)}const Z=s.enabledFeatures;if(Z&&Z.includes("depth-sensing")){const J=f.getDepthInformation(Dt[0]);J&&J.isValid&&J.texture&&M.init(t,J,s.renderState)}}for(let Dt=0;Dt<b.length;Dt++){const St=R[Dt],Z=b[Dt];St!==null&&Z!==void 0&&Z.update(St,pt,c||a)}gt&&gt(rt,pt),pt.detectedPlanes&&n.dispatchEvent({type:"planesdetected",data:pt}),x=null}const Vt=new yp;Vt.setAnimationLoop(xt),this.setAnimationLoop=function(rt){gt=rt},this.dispose=function(){}}}const ws=new Ai,Fy=new Ge;function By(i,t){function e(p,d){p.matrixAutoUpdate===!0&&p.updateMatrix(),d.value.copy(p.matrix)}function n(p,d){d.color.getRGB(p.fogColor.value,vp(i)),d.isFog?(p.fogNear.value=d.near,p.fogFar.value=d.far):d.isFogExp2&&(p.fogDensity.value=d.density)}function s(p,d,C,b,R){d.isMeshBasicMaterial||d.isMeshLambertMaterial?r(p,d):d.isMeshToonMaterial?(r(p,d),f(p,d)):d.isMeshPhongMaterial?(r(p,d),u(p,d)):d.isMeshStandardMaterial?(r(p,d),h(p,d),d.isMeshPhysicalMaterial&&_(p,d,R)):d.isMeshMatcapMaterial?(r(p,d),x(p,d)):d.isMeshDepthMaterial?r(p,d):d.isMeshDistanceMaterial?(r(p,d),M(p,d)):d.isMeshNormalMaterial?r(p,d):d.isLineBasicMaterial?(a(p,d),d.isLineDashedMaterial&&o(p,d)):d.isPointsMaterial?l(p,d,C,b):d.isSpriteMaterial?c(p,d):d.isShadowMaterial?(p.color.value.copy(d.color),p.opacity.value=d.opacity):d.isShaderMaterial&&(d.uniformsNeedUpdate=!1)}function r(p,d){p.opacity.value=d.opacity,d.color&&p.diffuse.value.copy(d.color),d.emissive&&p.emissive.value.copy(d.emissive).multiplyScalar(d.emissiveIntensity),d.map&&(p.map.value=d.map,e(d.map,p.mapTransform)),d.alphaMap&&(p.alphaMap.value=d.alphaMap,e(d.alphaMap,p.alphaMapTransform)),d.bumpMap&&(p.bumpMap.value=d.bumpMap,e(d.bumpMap,p.bumpMapTransform),p.bumpScale.value=d.bumpScale,d.side===On&&(p.bumpScale.value*=-1)),d.normalMap&&(p.normalMap.value=d.normalMap,e(d.normalMap,p.normalMapTransform),p.normalScale.value.copy(d.normalScale),d.side===On&&p.normalScale.value.negate()),d.displacementMap&&(p.displacementMap.value=d.displacementMap,e(d.displacementMap,p.displacementMapTransform),p.displacementScale.value=d.displacementScale,p.displacementBias.value=d.displacementBias),d.emissiveMap&&(p.emissiveMap.value=d.emissiveMap,e(d.emissiveMap,p.emissiveMapTransform)),d.specularMap&&(p.specularMap.value=d.specularMap,e(d.specularMap,p.specularMapTransform)),d.alphaTest>0&&(p.alphaTest.value=d.alphaTest);const C=t.get(d),b=C.envMap,R=C.envMapRotation;b&&(p.envMap.value=b,ws.copy(R),ws.x*=-1,ws.y*=-1,ws.z*=-1,b.isCubeTexture&&b.isRenderTargetTexture===!1&&(ws.y*=-1,ws.z*=-1),p.envMapRotation.value.setFromMatrix4(Fy.makeRotationFromEuler(ws)),p.flipEnvMap.value=b.isCubeTexture&&b.isRenderTargetTexture===!1?-1:1,p.reflectivity.value=d.reflectivity,p.ior.value=d.ior,p.refractionRatio.value=d.refractionRatio),d.lightMap&&(p.lightMap.value=d.lightMap,p.lightMapIntensity.value=d.lightMapIntensity,e(d.lightMap,p.lightMapTransform)),d.aoMap&&(p.aoMap.value=d.aoMap,p.aoMapIntensity.value=d.aoMapIntensity,e(d.aoMap,p.aoMapTransform))}function a(p,d){p.diffuse.value.copy(d.color),p.opacity.value=d.opacity,d.map&&(p.map.value=d.map,e(d.map,p.mapTransform))}function o(p,d){p.dashSize.value=d.dashSize,p.totalSize.value=d.dashSize+d.gapSize,p.scale.value=d.scale}function l(p,d,C,b){p.diffuse.value.copy(d.color),p.opacity.value=d.opacity,p.size.value=d.size*C,p.scale.value=b*.5,d.map&&(p.map.value=d.map,e(d.map,p.uvTransform)),d.alphaMap&&(p.alphaMap.value=d.alphaMap,e(d.alphaMap,p.alphaMapTransform)),d.alphaTest>0&&(p.alphaTest.value=d.alphaTest)}function c(p,d){p.diffuse.value.copy(d.color),p.opacity.value=d.opacity,p.rotation.value=d.rotation,d.map&&(p.map.value=d.map,e(d.map,p.mapTransform)),d.alphaMap&&(p.alphaMap.value=d.alphaMap,e(d.alphaMap,p.alphaMapTransform)),d.alphaTest>0&&(p.alphaTest.value=d.alphaTest)}function u(p,d){p.specular.value.copy(d.specular),p.shininess.value=Math.max(d.shininess,1e-4)}function f(p,d){d.gradientMap&&(p.gradientMap.value=d.gradientMap)}function h(p,d){p.metalness.value=d.metalness,d.metalnessMap&&(p.metalnessMap.value=d.metalnessMap,e(d.metalnessMap,p.metalnessMapTransform)),p.roughness.value=d.roughness,d.roughnessMap&&(p.roughnessMap.value=d.roughnessMap,e(d.roughnessMap,p.roughnessMapTransform)),d.envMap&&(p.envMapIntensity.value=d.envMapIntensity)}function _(p,d,C){p.ior.value=d.ior,d.sheen>0&&(p.sheenColor.value.copy(d.sheenColor).multiplyScalar(d.sheen),p.sheenRoughness.value=d.sheenRoughness,d.sheenColorMap&&(p.sheenColorMap.value=d.sheenColorMap,e(d.sheenColorMap,p.sheenColorMapTransform)),d.sheenRoughnessMap&&(p.sheenRoughnessMap.value=d.sheenRoughnessMap,e(d.sheenRoughnessMap,p.sheenRoughnessMapTransform))),d.clearcoat>0&&(p.clearcoat.value=d.clearcoat,p.clearcoatRoughness.value=d.clearcoatRoughness,d.clearcoatMap&&(p.clearcoatMap.value=d.clearcoatMap,e(d.clearcoatMap,p.clearcoatMapTransform)),d.clearcoatRoughnessMap&&(p.clearcoatRoughnessMap.value=d.clearcoatRoughnessMap,e(d.clearcoatRoughnessMap,p.clearcoatRoughnessMapTransform)),d.clearcoatNormalMap&&(p.clearcoatNormalMap.value=d.clearcoatNormalMap,e(d.clearcoatNormalMap,p.clearcoatNormalMapTransform),p.clearcoatNormalScale.value.copy(d.clearcoatNormalScale),d.side===On&&p.clearcoatNormalScale.value.negate())),d.dispersion>0&&(p.dispersion.value=d.dispersion),d.iridescence>0&&(p.iridescence.value=d.iridescence,p.iridescenceIOR.value=d.iridescenceIOR,p.iridescenceThicknessMinimum.value=d.iridescenceThicknessRange[0],p.iridescenceThicknessMaximum.value=d.iridescenceThicknessRange[1],d.iridescenceMap&&(p.iridescenceMap.value=d.iridescenceMap,e(d.iridescenceMap,p.iridescenceMapTransform)),d.iridescenceThicknessMap&&(p.iridescenceThicknessMap.value=d.iridescenceThicknessMap,e(d.iridescenceThicknessMap,p.iridescenceThicknessMapTransform))),d.transmission>0&&(p.transmission.value=d.transmission,p.transmissionSamplerMap.value=C.texture,p.transmissionSamplerSize.value.set(C.width,C.height),d.transmissionMap&&(p.transmissionMap.value=d.transmissionMap,e(d.transmissionMap,p.transmissionMapTransform)),p.thickness.value=d.thickness,d.thicknessMap&&(p.thicknessMap.value=d.thicknessMap,e(d.thicknessMap,p.thicknessMapTransform)),p.attenuationDistance.value=d.attenuationDistance,p.attenuationColor.value.copy(d.attenuationColor)),d.anisotropy>0&&(p.anisotropyVector.value.set(d.anisotropy*Math.cos(d.anisotropyRotation),d.anisotropy*Math.sin(d.anisotropyRotation)),d.anisotropyMap&&(p.anisotropyMap.value=d.anisotropyMap,e(d.anisotropyMap,p.anisotropyMapTransform))),p.specularIntensity.value=d.specularIntensity,p.specularColor.value.copy(d.specularColor),d.specularColorMap&&(p.specularColorMap.value=d.specularColorMap,e(d.specularColorMap,p.specularColorMapTransform)),d.specularIntensityMap&&(p.specularIntensityMap.value=d.specularIntensityMap,e(d.specularIntensityMap,p.specularIntensityMapTransform))}function x(p,d){d.matcap&&(p.matcap.value=d.matcap)}function M(p,d){const C=t.get(d).light;p.referencePosition.value.setFromMatrixPosition(C.matrixWorld),p.nearDistance.value=C.shadow.camera.near,p.farDistance.value=C.shadow.camera.far}return{refreshFogUniforms:n,refreshMaterialUniforms:s}}function zy(i,t,e,n){let s={},r={},a=[];const o=i.getParameter(i.MAX_UNIFORM_BUFFER_BINDINGS);function l(C,b){const R=b.program;n.uniformBlockBinding(C,R)}function c(C,b){let R=s[C.id];R===void 0&&(x(C),R=u(C),s[C.id]=R,C.addEventListener("dispose",p));const D=b.program;n.updateUBOMapping(C,D);const A=t.render.frame;r[C.id]!==A&&(h(C),r[C.id]=A)}function u(C){const b=f();C.__bindingPointIndex=b;const R=i.createBuffer(),D=C.__size,A=C.usage;return i.bindBuffer(i.UNIFORM_BUFFER,R),i.bufferData(i.UNIFORM_BUFFER,D,A),i.bindBuffer(i.UNIFORM_BUFFER,null),i.bindBufferBase(i.UNIFORM_BUFFER,b,R),R}function f(){for(let C=0;C<o;C++)if(a.indexOf(C)===-1)return a.push(C),C;return console.error("THREE.WebGLRenderer: Maximum number of simultaneously usable uniforms groups reached."),0}function h(C){const b=s[C.id],R=C.uniforms,D=C.__cache;i.bindBuffer(i.UNIFORM_BUFFER,b);for(let A=0,y=R.length;A<y;A++){const P=Array.isArray(R[A])?R[A]:[R[A]];for(let O=0,g=P.length;O<g;O++){const m=P[O];if(_(m,A,O,D)===!0){const E=m.__offset,N=Array.isArray(m.value)?m.value:[m.value];let F=0;for(let B=0;B<N.length;B++){const G=N[B],$=M(G);typeof G=="number"||typeof G=="boolean"?(m.__data[0]=G,i.bufferSubData(i.UNIFORM_BUFFER,E+F,m.__data)):G.isMatrix3?(m.__data[0]=G.elements[0],m.__data[1]=G.elements[1],m.__data[2]=G.elements[2],m.__data[3]=0,m.__data[4]=G.elements[3],m.__data[5]=G.elements[4],m.__data[6]=G.elements[5],m.__data[7]=0,m.__data[8]=G.elements[6],m.__data[9]=G.elements[7],m.__data[10]=G.elements[8],m.__data[11]=0):(G.toArray(m.__data,F),F+=$.storage/Float32Array.BYTES_PER_ELEMENT)}i.bufferSubData(i.UNIFORM_BUFFER,E,m.__data)}}}i.bindBuffer(i.UNIFORM_BUFFER,null)}function _(C,b,R,D){const A=C.value,y=b+"_"+R;if(D[y]===void 0)return typeof A=="number"||typeof A=="boolean"?D[y]=A:D[y]=A.clone(),!0;{const P=D[y];if(typeof A=="number"||typeof A=="boolean"){if(P!==A)return D[y]=A,!0}else if(P.equals(A)===!1)return P.copy(A),!0}return!1}function x(C){const b=C.uniforms;let R=0;const D=16;for(let y=0,P=b.length;y<P;y++){const O=Array.isArray(b[y])?b[y]:[b[y]];for(let g=0,m=O.length;g<m;g++){const E=O[g],N=Array.isArray(E.value)?E.value:[E.value];for(let F=0,B=N.length;F<B;F++){const G=N[F],$=M(G),Q=R%D,dt=Q%$.boundary,ct=Q+dt;R+=dt,ct!==0&&D-ct<$.storage&&(R+=D-ct),E.__data=new Float32Array($.storage/Float32Array.BYTES_PER_ELEMENT),E.__offset=R,R+=$.storage}}}const A=R%D;return A>0&&(R+=D-A),C.__size=R,C.__cache={},this}function M(C){const b={boundary:0,storage:0};return typeof C=="number"||typeof C=="boolean"?(b.boundary=4,b.storage=4):C.isVector2?(b.boundary=8,b.storage=8):C.isVector3||C.isColor?(b.boundary=16,b.storage=12):C.isVector4?(b.boundary=16,b.storage=16):C.isMatrix3?(b.boundary=48,b.storage=48):C.isMatrix4?(b.boundary=64,b.storage=64):C.isTexture?console.warn("THREE.WebGLRenderer: Texture samplers can not be part of an uniforms group."):console.warn("THREE.WebGLRenderer: Unsupported uniform value type.",C),b}function p(C){const b=C.target;b.removeEventListener("dispose",p);const R=a.indexOf(b.__bindingPointIndex);a.splice(R,1),i.deleteBuffer(s[b.id]),delete s[b.id],delete r[b.id]}function d(){for(const C in s)i.deleteBuffer(s[C]);a=[],s={},r={}}return{bind:l,update:c,dispose:d}}class Hy{constructor(t={}){const{canvas:e=R_(),context:n=null,depth:s=!0,stencil:r=!1,alpha:a=!1,antialias:o=!1,premultipliedAlpha:l=!0,preserveDrawingBuffer:c=!1,powerPreference:u="default",failIfMajorPerformanceCaveat:f=!1}=t;this.isWebGLRenderer=!0;let h;if(n!==null){if(typeof WebGLRenderingContext<"u"&&n instanceof WebGLRenderingContext)throw new Error("THREE.WebGLRenderer: WebGL 1 is not supported since r163.");h=n.getContextAttributes().alpha}else h=a;const _=new Uint32Array(4),x=new Int32Array(4);let M=null,p=null;const d=[],C=[];this.domElement=e,this.debug={checkShaderErrors:!0,onShaderError:null},this.autoClear=!0,this.autoClearColor=!0,this.autoClearDepth=!0,this.autoClearStencil=!0,this.sortObjects=!0,this.clippingPlanes=[],this.localClippingEnabled=!1,this._outputColorSpace=yi,this.toneMapping=ls,this.toneMappingExposure=1;const b=this;let R=!1,D=0,A=0,y=null,P=-1,O=null;const g=new je,m=new je;let E=null;const N=new ne(0);let F=0,B=e.width,G=e.height,$=1,Q=null,dt=null;const ct=new je(0,0,B,G),gt=new je(0,0,B,G);let xt=!1;const Vt=new Bh;let rt=!1,pt=!1;const Dt=new Ge,St=new Ge,Z=new j,J=new je,Y={background:null,fog:null,environment:null,overrideMaterial:null,isScene:!0};let at=!1;function ot(){return y===null?$:1}let I=n;function Ot(T,W){return e.getContext(T,W)}try{const T={alpha:!0,depth:s,stencil:r,antialias:o,premultipliedAlpha:l,preserveDrawingBuffer:c,powerPreference:u,failIfMajorPerformanceCaveat:f};if("setAttribute"in e&&e.setAttribute("data-engine",`three.js r${Ch}`),e.addEventListener("webglcontextlost",ft,!1),e.addEventListener("webglcontextrestored",Nt,!1),e.addEventListener("webglcontextcreationerror",Bt,!1),I===null){const W="webgl2";if(I=Ot(W,T),I===null)throw Ot(W)?new Error("Error creating WebGL context with your selected attributes."):new Error("Error creating WebGL context.")}}catch(T){throw console.error("THREE.WebGLRenderer: "+T.message),T}let Mt,Ht,At,Et,Xt,L,w,V,it,ht,nt,It,wt,Ut,re,mt,Rt,jt,$t,Lt,ie,te,pe,q;function Tt(){Mt=new qx(I),Mt.init(),te=new Ly(I,Mt),Ht=new zx(I,Mt,t,te),At=new Ry(I),Ht.reverseDepthBuffer&&At.buffers.depth.setReversed(!0),Et=new Kx(I),Xt=new dy,L=new Py(I,Mt,At,Xt,Ht,te,Et),w=new Gx(b),V=new Xx(b),it=new n0(I),pe=new Fx(I,it),ht=new Yx(I,it,Et,pe),nt=new Zx(I,ht,it,Et),$t=new $x(I,Ht,L),mt=new Hx(Xt),It=new fy(b,w,V,Mt,Ht,pe,mt),wt=new By(b,Xt),Ut=new my,re=new yy(Mt),jt=new Ox(b,w,V,At,nt,h,l),Rt=new Ty(b,nt,Ht),q=new zy(I,Et,Ht,At),Lt=new Bx(I,Mt,Et),ie=new jx(I,Mt,Et),Et.programs=It.programs,b.capabilities=Ht,b.extensions=Mt,b.properties=Xt,b.renderLists=Ut,b.shadowMap=Rt,b.state=At,b.info=Et}Tt();const lt=new Oy(b,I);this.xr=lt,this.getContext=function(){return I},this.getContextAttributes=function(){return I.getContextAttributes()},this.forceContextLoss=function(){const T=Mt.get("WEBGL_lose_context");T&&T.loseContext()},this.forceContextRestore=function(){const T=Mt.get("WEBGL_lose_context");T&&T.restoreContext()},this.getPixelRatio=function(){return $},this.setPixelRatio=function(T){T!==void 0&&($=T,this.setSize(B,G,!1))},this.getSize=function(T){return T.set(B,G)},this.setSize=function(T,W,tt=!0){if(lt.isPresenting){console.warn("THREE.WebGLRenderer: Can't change size while VR device is presenting.");return}B=T,G=W,e.width=Math.floor(T*$),e.height=Math.floor(W*$),tt===!0&&(e.style.width=T+"px",e.style.height=W+"px"),this.setViewport(0,0,T,W)},this.getDrawingBufferSize=function(T){return T.set(B*$,G*$).floor()},this.setDrawingBufferSize=function(T,W,tt){B=T,G=W,$=tt,e.width=Math.floor(T*tt),e.height=Math.floor(W*tt),this.setViewport(0,0,T,W)},this.getCurrentViewport=function(T){return T.copy(g)},this.getViewport=function(T){return T.copy(ct)},this.setViewport=function(T,W,tt,et){T.isVector4?ct.set(T.x,T.y,T.z,T.w):ct.set(T,W,tt,et),At.viewport(g.copy(ct).multiplyScalar($).round())},this.getScissor=function(T){return T.copy(gt)},this.setScissor=function(T,W,tt,et){T.isVector4?gt.set(T.x,T.y,T.z,T.w):gt.set(T,W,tt,et),At.scissor(m.copy(gt).multiplyScalar($).round())},this.getScissorTest=function(){return xt},this.setScissorTest=function(T){At.setScissorTest(xt=T)},this.setOpaqueSort=function(T){Q=T},this.setTransparentSort=function(T){dt=T},this.getClearColor=function(T){return T.copy(jt.getClearColor())},this.setClearColor=function(){jt.setClearColor.apply(jt,arguments)},this.getClearAlpha=function(){return jt.getClearAlpha()},this.setClearAlpha=function(){jt.setClearAlpha.apply(jt,arguments)},this.clear=function(T=!0,W=!0,tt=!0){let et=0;if(T){let K=!1;if(y!==null){const vt=y.texture.format;K=vt===kh||vt===Nh||vt===Uh}if(K){const vt=y.texture.type,Ct=vt===Vi||vt===Os||vt===Aa||vt===Or||vt===Dh||vt===Ih,Gt=jt.getClearColor(),Wt=jt.getClearAlpha(),Jt=Gt.r,Zt=Gt.g,qt=Gt.b;Ct?(_[0]=Jt,_[1]=Zt,_[2]=qt,_[3]=Wt,I.clearBufferuiv(I.COLOR,0,_)):(x[0]=Jt,x[1]=Zt,x[2]=qt,x[3]=Wt,I.clearBufferiv(I.COLOR,0,x))}else et|=I.COLOR_BUFFER_BIT}W&&(et|=I.DEPTH_BUFFER_BIT,I.clearDepth(this.capabilities.reverseDepthBuffer?0:1)),tt&&(et|=I.STENCIL_BUFFER_BIT,this.state.buffers.stencil.setMask(4294967295)),I.clear(et)},this.clearColor=function(){this.clear(!0,!1,!1)},this.clearDepth=function(){this.clear(!1,!0,!1)},this.clearStencil=function(){this.clear(!1,!1,!0)},this.dispose=function(){e.removeEventListener("webglcontextlost",ft,!1),e.removeEventListener("webglcontextrestored",Nt,!1),e.removeEventListener("webglcontextcreationerror",Bt,!1),Ut.dispose(),re.dispose(),Xt.dispose(),w.dispose(),V.dispose(),nt.dispose(),pe.dispose(),q.dispose(),It.dispose(),lt.dispose(),lt.removeEventListener("sessionstart",si),lt.removeEventListener("sessionend",Ri),Dn.stop()};function ft(T){T.preventDefault(),console.log("THREE.WebGLRenderer: Context Lost."),R=!0}function Nt(){console.log("THREE.WebGLRenderer: Context Restored."),R=!1;const T=Et.autoReset,W=Rt.enabled,tt=Rt.autoUpdate,et=Rt.needsUpdate,K=Rt.type;Tt(),Et.autoReset=T,Rt.enabled=W,Rt.autoUpdate=tt,Rt.needsUpdate=et,Rt.type=K}function Bt(T){console.error("THREE.WebGLRenderer: A WebGL context could not be created. Reason: ",T.statusMessage)}function fe(T){const W=T.target;W.removeEventListener("dispose",fe),We(W)}function We(T){_n(T),Xt.remove(T)}function _n(T){const W=Xt.get(T).programs;W!==void 0&&(W.forEach(function(tt){It.releaseProgram(tt)}),T.isShaderMaterial&&It.releaseShaderCache(T))}this.renderBufferDirect=function(T,W,tt,et,K,vt){W===null&&(W=Y);const Ct=K.isMesh&&K.matrixWorld.determinant()<0,Gt=ml(T,W,tt,et,K);At.setMaterial(et,Ct);let Wt=tt.index,Jt=1;if(et.wireframe===!0){if(Wt=ht.getWireframeAttribute(tt),Wt===void 0)return;Jt=2}const Zt=tt.drawRange,qt=tt.attributes.position;let ge=Zt.start*Jt,Se=(Zt.start+Zt.count)*Jt;vt!==null&&(ge=Math.max(ge,vt.start*Jt),Se=Math.min(Se,(vt.start+vt.count)*Jt)),Wt!==null?(ge=Math.max(ge,0),Se=Math.min(Se,Wt.count)):qt!=null&&(ge=Math.max(ge,0),Se=Math.min(Se,qt.count));const Ie=Se-ge;if(Ie<0||Ie===1/0)return;pe.setup(K,et,Gt,tt,Wt);let pn,me=Lt;if(Wt!==null&&(pn=it.get(Wt),me=ie,me.setIndex(pn)),K.isMesh)et.wireframe===!0?(At.setLineWidth(et.wireframeLinewidth*ot()),me.setMode(I.LINES)):me.setMode(I.TRIANGLES);else if(K.isLine){let Kt=et.linewidth;Kt===void 0&&(Kt=1),At.setLineWidth(Kt*ot()),K.isLineSegments?me.setMode(I.LINES):K.isLineLoop?me.setMode(I.LINE_LOOP):me.setMode(I.LINE_STRIP)}else K.isPoints?me.setMode(I.POINTS):K.isSprite&&me.setMode(I.TRIANGLES);if(K.isBatchedMesh)if(K._multiDrawInstances!==null)me.renderMultiDrawInstances(K._multiDrawStarts,K._multiDrawCounts,K._multiDrawCount,K._multiDrawInstances);else if(Mt.get("WEBGL_multi_draw"))me.renderMultiDraw(K._multiDrawStarts,K._multiDrawCounts,K._multiDrawCount);else{const Kt=K._multiDrawStarts,Re=K._multiDrawCounts,_e=K._multiDrawCount,In=Wt?it.get(Wt).bytesPerElement:1,mi=Xt.get(et).currentProgram.getUniforms();for(let xn=0;xn<_e;xn++)mi.setValue(I,"_gl_DrawID",xn),me.render(Kt[xn]/In,Re[xn])}else if(K.isInstancedMesh)me.renderInstances(ge,Ie,K.count);else if(tt.isInstancedBufferGeometry){const Kt=tt._maxInstanceCount!==void 0?tt._maxInstanceCount:1/0,Re=Math.min(tt.instanceCount,Kt);me.renderInstances(ge,Ie,Re)}else me.render(ge,Ie)};function bt(T,W,tt){T.transparent===!0&&T.side===Fi&&T.forceSinglePass===!1?(T.side=On,T.needsUpdate=!0,Ws(T,W,tt),T.side=us,T.needsUpdate=!0,Ws(T,W,tt),T.side=Fi):Ws(T,W,tt)}this.compile=function(T,W,tt=null){tt===null&&(tt=T),p=re.get(tt),p.init(W),C.push(p),tt.traverseVisible(function(K){K.isLight&&K.layers.test(W.layers)&&(p.pushLight(K),K.castShadow&&p.pushShadow(K))}),T!==tt&&T.traverseVisible(function(K){K.isLight&&K.layers.test(W.layers)&&(p.pushLight(K),K.castShadow&&p.pushShadow(K))}),p.setupLights();const et=new Set;return T.traverse(function(K){if(!(K.isMesh||K.isPoints||K.isLine||K.isSprite))return;const vt=K.material;if(vt)if(Array.isArray(vt))for(let Ct=0;Ct<vt.length;Ct++){const Gt=vt[Ct];bt(Gt,tt,K),et.add(Gt)}else bt(vt,tt,K),et.add(vt)}),C.pop(),p=null,et},this.compileAsync=function(T,W,tt=null){const et=this.compile(T,W,tt);return new Promise(K=>{function vt(){if(et.forEach(function(Ct){Xt.get(Ct).currentProgram.isReady()&&et.delete(Ct)}),et.size===0){K(T);return}setTimeout(vt,10)}Mt.get("KHR_parallel_shader_compile")!==null?vt():setTimeout(vt,10)})};let Xe=null;function De(T){Xe&&Xe(T)}function si(){Dn.stop()}function Ri(){Dn.start()}const Dn=new yp;Dn.setAnimationLoop(De),typeof self<"u"&&Dn.setContext(self),this.setAnimationLoop=function(T){Xe=T,lt.setAnimationLoop(T),T===null?Dn.stop():Dn.start()},lt.addEventListener("sessionstart",si),lt.addEventListener("sessionend",Ri),this.render=function(T,W){if(W!==void 0&&W.isCamera!==!0){console.error("THREE.WebGLRenderer.render: camera is not an instance of THREE.Camera.");return}if(R===!0)return;if(T.matrixWorldAutoUpdate===!0&&T.updateMatrixWorld(),W.parent===null&&W.matrixWorldAutoUpdate===!0&&W.updateMatrixWorld(),lt.enabled===!0&&lt.isPresenting===!0&&(lt.cameraAutoUpdate===!0&&lt.updateCamera(W),W=lt.getCamera()),T.isScene===!0&&T.onBeforeRender(b,T,W,y),p=re.get(T,C.length),p.init(W),C.push(p),St.multiplyMatrices(W.projectionMatrix,W.matrixWorldInverse),Vt.setFromProjectionMatrix(St),pt=this.localClippingEnabled,rt=mt.init(this.clippingPlanes,pt),M=Ut.get(T,d.length),M.init(),d.push(M),lt.enabled===!0&&lt.isPresenting===!0){const vt=b.xr.getDepthSensingMesh();vt!==null&&vn(vt,W,-1/0,b.sortObjects)}vn(T,W,0,b.sortObjects),M.finish(),b.sortObjects===!0&&M.sort(Q,dt),at=lt.enabled===!1||lt.isPresenting===!1||lt.hasDepthSensing()===!1,at&&jt.addToRenderList(M,T),this.info.render.frame++,rt===!0&&mt.beginShadows();const tt=p.state.shadowsArray;Rt.render(tt,T,W),rt===!0&&mt.endShadows(),this.info.autoReset===!0&&this.info.reset();const et=M.opaque,K=M.transmissive;if(p.setupLights(),W.isArrayCamera){const vt=W.cameras;if(K.length>0)for(let Ct=0,Gt=vt.length;Ct<Gt;Ct++){const Wt=vt[Ct];Pi(et,K,T,Wt)}at&&jt.render(T);for(let Ct=0,Gt=vt.length;Ct<Gt;Ct++){const Wt=vt[Ct];Ci(M,T,Wt,Wt.viewport)}}else K.length>0&&Pi(et,K,T,W),at&&jt.render(T),Ci(M,T,W);y!==null&&(L.updateMultisampleRenderTarget(y),L.updateRenderTargetMipmap(y)),T.isScene===!0&&T.onAfterRender(b,T,W),pe.resetDefaultState(),P=-1,O=null,C.pop(),C.length>0?(p=C[C.length-1],rt===!0&&mt.setGlobalState(b.clippingPlanes,p.state.camera)):p=null,d.pop(),d.length>0?M=d[d.length-1]:M=null};function vn(T,W,tt,et){if(T.visible===!1)return;if(T.layers.test(W.layers)){if(T.isGroup)tt=T.renderOrder;else if(T.isLOD)T.autoUpdate===!0&&T.update(W);else if(T.isLight)p.pushLight(T),T.castShadow&&p.pushShadow(T);else if(T.isSprite){if(!T.frustumCulled||Vt.intersectsSprite(T)){et&&J.setFromMatrixPosition(T.matrixWorld).applyMatrix4(St);const Ct=nt.update(T),Gt=T.material;Gt.visible&&M.push(T,Ct,Gt,tt,J.z,null)}}else if((T.isMesh||T.isLine||T.isPoints)&&(!T.frustumCulled||Vt.intersectsObject(T))){const Ct=nt.update(T),Gt=T.material;if(et&&(T.boundingSphere!==void 0?(T.boundingSphere===null&&T.computeBoundingSphere(),J.copy(T.boundingSphere.center)):(Ct.boundingSphere===null&&Ct.computeBoundingSphere(),J.copy(Ct.boundingSphere.center)),J.applyMatrix4(T.matrixWorld).applyMatrix4(St)),Array.isArray(Gt)){const Wt=Ct.groups;for(let Jt=0,Zt=Wt.length;Jt<Zt;Jt++){const qt=Wt[Jt],ge=Gt[qt.materialIndex];ge&&ge.visible&&M.push(T,Ct,ge,tt,J.z,qt)}}else Gt.visible&&M.push(T,Ct,Gt,tt,J.z,null)}}const vt=T.children;for(let Ct=0,Gt=vt.length;Ct<Gt;Ct++)vn(vt[Ct],W,tt,et)}function Ci(T,W,tt,et){const K=T.opaque,vt=T.transmissive,Ct=T.transparent;p.setupLightsView(tt),rt===!0&&mt.setGlobalState(b.clippingPlanes,tt),et&&At.viewport(g.copy(et)),K.length>0&&ms(K,W,tt),vt.length>0&&ms(vt,W,tt),Ct.length>0&&ms(Ct,W,tt),At.buffers.depth.setTest(!0),At.buffers.depth.setMask(!0),At.buffers.color.setMask(!0),At.setPolygonOffset(!1)}function Pi(T,W,tt,et){if((tt.isScene===!0?tt.overrideMaterial:null)!==null)return;p.state.transmissionRenderTarget[et.id]===void 0&&(p.state.transmissionRenderTarget[et.id]=new Fs(1,1,{generateMipmaps:!0,type:Mt.has("EXT_color_buffer_half_float")||Mt.has("EXT_color_buffer_float")?Pa:Vi,minFilter:Ds,samples:4,stencilBuffer:r,resolveDepthBuffer:!1,resolveStencilBuffer:!1,colorSpace:ye.workingColorSpace}));const vt=p.state.transmissionRenderTarget[et.id],Ct=et.viewport||g;vt.setSize(Ct.z,Ct.w);const Gt=b.getRenderTarget();b.setRenderTarget(vt),b.getClearColor(N),F=b.getClearAlpha(),F<1&&b.setClearColor(16777215,.5),b.clear(),at&&jt.render(tt);const Wt=b.toneMapping;b.toneMapping=ls;const Jt=et.viewport;if(et.viewport!==void 0&&(et.viewport=void 0),p.setupLightsView(et),rt===!0&&mt.setGlobalState(b.clippingPlanes,et),ms(T,tt,et),L.updateMultisampleRenderTarget(vt),L.updateRenderTargetMipmap(vt),Mt.has("WEBGL_multisampled_render_to_texture")===!1){let Zt=!1;for(let qt=0,ge=W.length;qt<ge;qt++){const Se=W[qt],Ie=Se.object,pn=Se.geometry,me=Se.material,Kt=Se.group;if(me.side===Fi&&Ie.layers.test(et.layers)){const Re=me.side;me.side=On,me.needsUpdate=!0,Zr(Ie,tt,et,pn,me,Kt),me.side=Re,me.needsUpdate=!0,Zt=!0}}Zt===!0&&(L.updateMultisampleRenderTarget(vt),L.updateRenderTargetMipmap(vt))}b.setRenderTarget(Gt),b.setClearColor(N,F),Jt!==void 0&&(et.viewport=Jt),b.toneMapping=Wt}function ms(T,W,tt){const et=W.isScene===!0?W.overrideMaterial:null;for(let K=0,vt=T.length;K<vt;K++){const Ct=T[K],Gt=Ct.object,Wt=Ct.geometry,Jt=et===null?Ct.material:et,Zt=Ct.group;Gt.layers.test(tt.layers)&&Zr(Gt,W,tt,Wt,Jt,Zt)}}function Zr(T,W,tt,et,K,vt){T.onBeforeRender(b,W,tt,et,K,vt),T.modelViewMatrix.multiplyMatrices(tt.matrixWorldInverse,T.matrixWorld),T.normalMatrix.getNormalMatrix(T.modelViewMatrix),K.onBeforeRender(b,W,tt,et,T,vt),K.transparent===!0&&K.side===Fi&&K.forceSinglePass===!1?(K.side=On,K.needsUpdate=!0,b.renderBufferDirect(tt,W,et,K,T,vt),K.side=us,K.needsUpdate=!0,b.renderBufferDirect(tt,W,et,K,T,vt),K.side=Fi):b.renderBufferDirect(tt,W,et,K,T,vt),T.onAfterRender(b,W,tt,et,K,vt)}function Ws(T,W,tt){W.isScene!==!0&&(W=Y);const et=Xt.get(T),K=p.state.lights,vt=p.state.shadowsArray,Ct=K.state.version,Gt=It.getParameters(T,K.state,vt,W,tt),Wt=It.getProgramCacheKey(Gt);let Jt=et.programs;et.environment=T.isMeshStandardMaterial?W.environment:null,et.fog=W.fog,et.envMap=(T.isMeshStandardMaterial?V:w).get(T.envMap||et.environment),et.envMapRotation=et.environment!==null&&T.envMap===null?W.environmentRotation:T.envMapRotation,Jt===void 0&&(T.addEventListener("dispose",fe),Jt=new Map,et.programs=Jt);let Zt=Jt.get(Wt);if(Zt!==void 0){if(et.currentProgram===Zt&&et.lightsStateVersion===Ct)return pi(T,Gt),Zt}else Gt.uniforms=It.getUniforms(T),T.onBeforeCompile(Gt,b),Zt=It.acquireProgram(Gt,Wt),Jt.set(Wt,Zt),et.uniforms=Gt.uniforms;const qt=et.uniforms;return(!T.isShaderMaterial&&!T.isRawShaderMaterial||T.clipping===!0)&&(qt.clippingPlanes=mt.uniform),pi(T,Gt),et.needsLights=Ua(T),et.lightsStateVersion=Ct,et.needsLights&&(qt.ambientLightColor.value=K.state.ambient,qt.lightProbe.value=K.state.probe,qt.directionalLights.value=K.state.directional,qt.directionalLightShadows.value=K.state.directionalShadow,qt.spotLights.value=K.state.spot,qt.spotLightShadows.value=K.state.spotShadow,qt.rectAreaLights.value=K.state.rectArea,qt.ltc_1.value=K.state.rectAreaLTC1,qt.ltc_2.value=K.state.rectAreaLTC2,qt.pointLights.value=K.state.point,qt.pointLightShadows.value=K.state.pointShadow,qt.hemisphereLights.value=K.state.hemi,qt.directionalShadowMap.value=K.state.directionalShadowMap,qt.directionalShadowMatrix.value=K.state.directionalShadowMatrix,qt.spotShadowMap.value=K.state.spotShadowMap,qt.spotLightMatrix.value=K.state.spotLightMatrix,qt.spotLightMap.value=K.state.spotLightMap,qt.pointShadowMap.value=K.state.pointShadowMap,qt.pointShadowMatrix.value=K.state.pointShadowMatrix),et.currentProgram=Zt,et.uniformsList=null,Zt}function Ia(T){if(T.uniformsList===null){const W=T.currentProgram.getUniforms();T.uniformsList=Uo.seqWithValue(W.seq,T.uniforms)}return T.uniformsList}function pi(T,W){const tt=Xt.get(T);tt.outputColorSpace=W.outputColorSpace,tt.batching=W.batching,tt.batchingColor=W.batchingColor,tt.instancing=W.instancing,tt.instancingColor=W.instancingColor,tt.instancingMorph=W.instancingMorph,tt.skinning=W.skinning,tt.morphTargets=W.morphTargets,tt.morphNormals=W.morphNormals,tt.morphColors=W.morphColors,tt.morphTargetsCount=W.morphTargetsCount,tt.numClippingPlanes=W.numClippingPlanes,tt.numIntersection=W.numClipIntersection,tt.vertexAlphas=W.vertexAlphas,tt.vertexTangents=W.vertexTangents,tt.toneMapping=W.toneMapping}function ml(T,W,tt,et,K){W.isScene!==!0&&(W=Y),L.resetTextureUnits();const vt=W.fog,Ct=et.isMeshStandardMaterial?W.environment:null,Gt=y===null?b.outputColorSpace:y.isXRRenderTarget===!0?y.texture.colorSpace:ps,Wt=(et.isMeshStandardMaterial?V:w).get(et.envMap||Ct),Jt=et.vertexColors===!0&&!!tt.attributes.color&&tt.attributes.color.itemSize===4,Zt=!!tt.attributes.tangent&&(!!et.normalMap||et.anisotropy>0),qt=!!tt.morphAttributes.position,ge=!!tt.morphAttributes.normal,Se=!!tt.morphAttributes.color;let Ie=ls;et.toneMapped&&(y===null||y.isXRRenderTarget===!0)&&(Ie=b.toneMapping);const pn=tt.morphAttributes.position||tt.morphAttributes.normal||tt.morphAttributes.color,me=pn!==void 0?pn.length:0,Kt=Xt.get(et),Re=p.state.lights;if(rt===!0&&(pt===!0||T!==O)){const wn=T===O&&et.id===P;mt.setState(et,T,wn)}let _e=!1;et.version===Kt.__version?(Kt.needsLights&&Kt.lightsStateVersion!==Re.state.version||Kt.outputColorSpace!==Gt||K.isBatchedMesh&&Kt.batching===!1||!K.isBatchedMesh&&Kt.batching===!0||K.isBatchedMesh&&Kt.batchingColor===!0&&K.colorTexture===null||K.isBatchedMesh&&Kt.batchingColor===!1&&K.colorTexture!==null||K.isInstancedMesh&&Kt.instancing===!1||!K.isInstancedMesh&&Kt.instancing===!0||K.isSkinnedMesh&&Kt.skinning===!1||!K.isSkinnedMesh&&Kt.skinning===!0||K.isInstancedMesh&&Kt.instancingColor===!0&&K.instanceColor===null||K.isInstancedMesh&&Kt.instancingColor===!1&&K.instanceColor!==null||K.isInstancedMesh&&Kt.instancingMorph===!0&&K.morphTexture===null||K.isInstancedMesh&&Kt.instancingMorph===!1&&K.morphTexture!==null||Kt.envMap!==Wt||et.fog===!0&&Kt.fog!==vt||Kt.numClippingPlanes!==void 0&&(Kt.numClippingPlanes!==mt.numPlanes||Kt.numIntersection!==mt.numIntersection)||Kt.vertexAlphas!==Jt||Kt.vertexTangents!==Zt||Kt.morphTargets!==qt||Kt.morphNormals!==ge||Kt.morphColors!==Se||Kt.toneMapping!==Ie||Kt.morphTargetsCount!==me)&&(_e=!0):(_e=!0,Kt.__version=et.version);let In=Kt.currentProgram;_e===!0&&(In=Ws(et,W,K));let mi=!1,xn=!1,Jr=!1;const Ve=In.getUniforms(),gi=Kt.uniforms;if(At.useProgram(In.program)&&(mi=!0,xn=!0,Jr=!0),et.id!==P&&(P=et.id,xn=!0),mi||O!==T){Ht.reverseDepthBuffer?(Dt.copy(T.projectionMatrix),P_(Dt),L_(Dt),Ve.setValue(I,"projectionMatrix",Dt)):Ve.setValue(I,"projectionMatrix",T.projectionMatrix),Ve.setValue(I,"viewMatrix",T.matrixWorldInverse);const wn=Ve.map.cameraPosition;wn!==void 0&&wn.setValue(I,Z.setFromMatrixPosition(T.matrixWorld)),Ht.logarithmicDepthBuffer&&Ve.setValue(I,"logDepthBufFC",2/(Math.log(T.far+1)/Math.LN2)),(et.isMeshPhongMaterial||et.isMeshToonMaterial||et.isMeshLambertMaterial||et.isMeshBasicMaterial||et.isMeshStandardMaterial||et.isShaderMaterial)&&Ve.setValue(I,"isOrthographic",T.isOrthographicCamera===!0),O!==T&&(O=T,xn=!0,Jr=!0)}if(K.isSkinnedMesh){Ve.setOptional(I,K,"bindMatrix"),Ve.setOptional(I,K,"bindMatrixInverse");const wn=K.skeleton;wn&&(wn.boneTexture===null&&wn.computeBoneTexture(),Ve.setValue(I,"boneTexture",wn.boneTexture,L))}K.isBatchedMesh&&(Ve.setOptional(I,K,"batchingTexture"),Ve.setValue(I,"batchingTexture",K._matricesTexture,L),Ve.setOptional(I,K,"batchingIdTexture"),Ve.setValue(I,"batchingIdTexture",K._indirectTexture,L),Ve.setOptional(I,K,"batchingColorTexture"),K._colorsTexture!==null&&Ve.setValue(I,"batchingColorTexture",K._colorsTexture,L));const Xs=tt.morphAttributes;if((Xs.position!==void 0||Xs.normal!==void 0||Xs.color!==void 0)&&$t.update(K,tt,In),(xn||Kt.receiveShadow!==K.receiveShadow)&&(Kt.receiveShadow=K.receiveShadow,Ve.setValue(I,"receiveShadow",K.receiveShadow)),et.isMeshGouraudMaterial&&et.envMap!==null&&(gi.envMap.value=Wt,gi.flipEnvMap.value=Wt.isCubeTexture&&Wt.isRenderTargetTexture===!1?-1:1),et.isMeshStandardMaterial&&et.envMap===null&&W.environment!==null&&(gi.envMapIntensity.value=W.environmentIntensity),xn&&(Ve.setValue(I,"toneMappingExposure",b.toneMappingExposure),Kt.needsLights&&gs(gi,Jr),vt&&et.fog===!0&&wt.refreshFogUniforms(gi,vt),wt.refreshMaterialUniforms(gi,et,$,G,p.state.transmissionRenderTarget[T.id]),Uo.upload(I,Ia(Kt),gi,L)),et.isShaderMaterial&&et.uniformsNeedUpdate===!0&&(Uo.upload(I,Ia(Kt),gi,L),et.uniformsNeedUpdate=!1),et.isSpriteMaterial&&Ve.setValue(I,"center",K.center),Ve.setValue(I,"modelViewMatrix",K.modelViewMatrix),Ve.setValue(I,"normalMatrix",K.normalMatrix),Ve.setValue(I,"modelMatrix",K.matrixWorld),et.isShaderMaterial||et.isRawShaderMaterial){const wn=et.uniformsGroups;for(let Qr=0,Na=wn.length;Qr<Na;Qr++){const qs=wn[Qr];q.update(qs,In),q.bind(qs,In)}}return In}function gs(T,W){T.ambientLightColor.needsUpdate=W,T.lightProbe.needsUpdate=W,T.directionalLights.needsUpdate=W,T.directionalLightShadows.needsUpdate=W,T.pointLights.needsUpdate=W,T.pointLightShadows.needsUpdate=W,T.spotLights.needsUpdate=W,T.spotLightShadows.needsUpdate=W,T.rectAreaLights.needsUpdate=W,T.hemisphereLights.needsUpdate=W}function Ua(T){return T.isMeshLambertMaterial||T.isMeshToonMaterial||T.isMeshPhongMaterial||T.isMeshStandardMaterial||T.isShadowMaterial||T.isShaderMaterial&&T.lights===!0}this.getActiveCubeFace=function(){return D},this.getActiveMipmapLevel=function(){return A},this.getRenderTarget=function(){return y},this.setRenderTargetTextures=function(T,W,tt){Xt.get(T.texture).__webglTexture=W,Xt.get(T.depthTexture).__webglTexture=tt;const et=Xt.get(T);et.__hasExternalTextures=!0,et.__autoAllocateDepthBuffer=tt===void 0,et.__autoAllocateDepthBuffer||Mt.has("WEBGL_multisampled_render_to_texture")===!0&&(console.warn("THREE.WebGLRenderer: Render-to-texture extension was disabled because an external texture was provided"),et.__useRenderToTexture=!1)},this.setRenderTargetFramebuffer=function(T,W){const tt=Xt.get(T);tt.__webglFramebuffer=W,tt.__useDefaultFramebuffer=W===void 0},this.setRenderTarget=function(T,W=0,tt=0){y=T,D=W,A=tt;let et=!0,K=null,vt=!1,Ct=!1;if(T){const Wt=Xt.get(T);if(Wt.__useDefaultFramebuffer!==void 0)At.bindFramebuffer(I.FRAMEBUFFER,null),et=!1;else if(Wt.__webglFramebuffer===void 0)L.setupRenderTarget(T);else if(Wt.__hasExternalTextures)L.rebindTextures(T,Xt.get(T.texture).__webglTexture,Xt.get(T.depthTexture).__webglTexture);else if(T.depthBuffer){const qt=T.depthTexture;if(Wt.__boundDepthTexture!==qt){if(qt!==null&&Xt.has(qt)&&(T.width!==qt.image.width||T.height!==qt.image.height))throw new Error("WebGLRenderTarget: Attached DepthTexture is initialized to the incorrect size.");L.setupDepthRenderbuffer(T)}}const Jt=T.texture;(Jt.isData3DTexture||Jt.isDataArrayTexture||Jt.isCompressedArrayTexture)&&(Ct=!0);const Zt=Xt.get(T).__webglFramebuffer;T.isWebGLCubeRenderTarget?(Array.isArray(Zt[W])?K=Zt[W][tt]:K=Zt[W],vt=!0):T.samples>0&&L.useMultisampledRTT(T)===!1?K=Xt.get(T).__webglMultisampledFramebuffer:Array.isArray(Zt)?K=Zt[tt]:K=Zt,g.copy(T.viewport),m.copy(T.scissor),E=T.scissorTest}else g.copy(ct).multiplyScalar($).floor(),m.copy(gt).multiplyScalar($).floor(),E=xt;if(At.bindFramebuffer(I.FRAMEBUFFER,K)&&et&&At.drawBuffers(T,K),At.viewport(g),At.scissor(m),At.setScissorTest(E),vt){const Wt=Xt.get(T.texture);I.framebufferTexture2D(I.FRAMEBUFFER,I.COLOR_ATTACHMENT0,I.TEXTURE_CUBE_MAP_POSITIVE_X+W,Wt.__webglTexture,tt)}else if(Ct){const Wt=Xt.get(T.texture),Jt=W||0;I.framebufferTextureLayer(I.FRAMEBUFFER,I.COLOR_ATTACHMENT0,Wt.__webglTexture,tt||0,Jt)}P=-1},this.readRenderTargetPixels=function(T,W,tt,et,K,vt,Ct){if(!(T&&T.isWebGLRenderTarget)){console.error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");return}let Gt=Xt.get(T).__webglFramebuffer;if(T.isWebGLCubeRenderTarget&&Ct!==void 0&&(Gt=Gt[Ct]),Gt){At.bindFramebuffer(I.FRAMEBUFFER,Gt);try{const Wt=T.texture,Jt=Wt.format,Zt=Wt.type;if(!Ht.textureFormatReadable(Jt)){console.error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not in RGBA or implementation defined format.");return}if(!Ht.textureTypeReadable(Zt)){console.error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not in UnsignedByteType or implementation defined type.");return}W>=0&&W<=T.width-et&&tt>=0&&tt<=T.height-K&&I.readPixels(W,tt,et,K,te.convert(Jt),te.convert(Zt),vt)}finally{const Wt=y!==null?Xt.get(y).__webglFramebuffer:null;At.bindFramebuffer(I.FRAMEBUFFER,Wt)}}},this.readRenderTargetPixelsAsync=async function(T,W,tt,et,K,vt,Ct){if(!(T&&T.isWebGLRenderTarget))throw new Error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");let Gt=Xt.get(T).__webglFramebuffer;if(T.isWebGLCubeRenderTarget&&Ct!==void 0&&(Gt=Gt[Ct]),Gt){const Wt=T.texture,Jt=Wt.format,Zt=Wt.type;if(!Ht.textureFormatReadable(Jt))throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in RGBA or implementation defined format.");if(!Ht.textureTypeReadable(Zt))throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in UnsignedByteType or implementation defined type.");if(W>=0&&W<=T.width-et&&tt>=0&&tt<=T.height-K){At.bindFramebuffer(I.FRAMEBUFFER,Gt);const qt=I.createBuffer();I.bindBuffer(I.PIXEL_PACK_BUFFER,qt),I.bufferData(I.PIXEL_PACK_BUFFER,vt.byteLength,I.STREAM_READ),I.readPixels(W,tt,et,K,te.convert(Jt),te.convert(Zt),0);const ge=y!==null?Xt.get(y).__webglFramebuffer:null;At.bindFramebuffer(I.FRAMEBUFFER,ge);const Se=I.fenceSync(I.SYNC_GPU_COMMANDS_COMPLETE,0);return I.flush(),await C_(I,Se,4),I.bindBuffer(I.PIXEL_PACK_BUFFER,qt),I.getBufferSubData(I.PIXEL_PACK_BUFFER,0,vt),I.deleteBuffer(qt),I.deleteSync(Se),vt}else throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: requested read bounds are out of range.")}},this.copyFramebufferToTexture=function(T,W=null,tt=0){T.isTexture!==!0&&(Io("WebGLRenderer: copyFramebufferToTexture function signature has changed."),W=arguments[0]||null,T=arguments[1]);const et=Math.pow(2,-tt),K=Math.floor(T.image.width*et),vt=Math.floor(T.image.height*et),Ct=W!==null?W.x:0,Gt=W!==null?W.y:0;L.setTexture2D(T,0),I.copyTexSubImage2D(I.TEXTURE_2D,tt,0,0,Ct,Gt,K,vt),At.unbindTexture()},this.copyTextureToTexture=function(T,W,tt=null,et=null,K=0){T.isTexture!==!0&&(Io("WebGLRenderer: copyTextureToTexture function signature has changed."),et=arguments[0]||null,T=arguments[1],W=arguments[2],K=arguments[3]||0,tt=null);let vt,Ct,Gt,Wt,Jt,Zt;tt!==null?(vt=tt.max.x-tt.min.x,Ct=tt.max.y-tt.min.y,Gt=tt.min.x,Wt=tt.min.y):(vt=T.image.width,Ct=T.image.height,Gt=0,Wt=0),et!==null?(Jt=et.x,Zt=et.y):(Jt=0,Zt=0);const qt=te.convert(W.format),ge=te.convert(W.type);L.setTexture2D(W,0),I.pixelStorei(I.UNPACK_FLIP_Y_WEBGL,W.flipY),I.pixelStorei(I.UNPACK_PREMULTIPLY_ALPHA_WEBGL,W.premultiplyAlpha),I.pixelStorei(I.UNPACK_ALIGNMENT,W.unpackAlignment);const Se=I.getParameter(I.UNPACK_ROW_LENGTH),Ie=I.getParameter(I.UNPACK_IMAGE_HEIGHT),pn=I.getParameter(I.UNPACK_SKIP_PIXELS),me=I.getParameter(I.UNPACK_SKIP_ROWS),Kt=I.getParameter(I.UNPACK_SKIP_IMAGES),Re=T.isCompressedTexture?T.mipmaps[K]:T.image;I.pixelStorei(I.UNPACK_ROW_LENGTH,Re.width),I.pixelStorei(I.UNPACK_IMAGE_HEIGHT,Re.height),I.pixelStorei(I.UNPACK_SKIP_PIXELS,Gt),I.pixelStorei(I.UNPACK_SKIP_ROWS,Wt),T.isDataTexture?I.texSubImage2D(I.TEXTURE_2D,K,Jt,Zt,vt,Ct,qt,ge,Re.data):T.isCompressedTexture?I.compressedTexSubImage2D(I.TEXTURE_2D,K,Jt,Zt,Re.width,Re.height,qt,Re.data):I.texSubImage2D(I.TEXTURE_2D,K,Jt,Zt,vt,Ct,qt,ge,Re),I.pixelStorei(I.UNPACK_ROW_LENGTH,Se),I.pixelStorei(I.UNPACK_IMAGE_HEIGHT,Ie),I.pixelStorei(I.UNPACK_SKIP_PIXELS,pn),I.pixelStorei(I.UNPACK_SKIP_ROWS,me),I.pixelStorei(I.UNPACK_SKIP_IMAGES,Kt),K===0&&W.generateMipmaps&&I.generateMipmap(I.TEXTURE_2D),At.unbindTexture()},this.copyTextureToTexture3D=function(T,W,tt=null,et=null,K=0){T.isTexture!==!0&&(Io("WebGLRenderer: copyTextureToTexture3D function signature has changed."),tt=arguments[0]||null,et=arguments[1]||null,T=arguments[2],W=arguments[3],K=arguments[4]||0);let vt,Ct,Gt,Wt,Jt,Zt,qt,ge,Se;const Ie=T.isCompressedTexture?T.mipmaps[K]:T.image;tt!==null?(vt=tt.max.x-tt.min.x,Ct=tt.max.y-tt.min.y,Gt=tt.max.z-tt.min.z,Wt=tt.min.x,Jt=tt.min.y,Zt=tt.min.z):(vt=Ie.width,Ct=Ie.height,Gt=Ie.depth,Wt=0,Jt=0,Zt=0),et!==null?(qt=et.x,ge=et.y,Se=et.z):(qt=0,ge=0,Se=0);const pn=te.convert(W.format),me=te.convert(W.type);let Kt;if(W.isData3DTexture)L.setTexture3D(W,0),Kt=I.TEXTURE_3D;else if(W.isDataArrayTexture||W.isCompressedArrayTexture)L.setTexture2DArray(W,0),Kt=I.TEXTURE_2D_ARRAY;else{console.warn("THREE.WebGLRenderer.copyTextureToTexture3D: only supports THREE.DataTexture3D and THREE.DataTexture2DArray.");return}I.pixelStorei(I.UNPACK_FLIP_Y_WEBGL,W.flipY),I.pixelStorei(I.UNPACK_PREMULTIPLY_ALPHA_WEBGL,W.premultiplyAlpha),I.pixelStorei(I.UNPACK_ALIGNMENT,W.unpackAlignment);const Re=I.getParameter(I.UNPACK_ROW_LENGTH),_e=I.getParameter(I.UNPACK_IMAGE_HEIGHT),In=I.getParameter(I.UNPACK_SKIP_PIXELS),mi=I.getParameter(I.UNPACK_SKIP_ROWS),xn=I.getParameter(I.UNPACK_SKIP_IMAGES);I.pixelStorei(I.UNPACK_ROW_LENGTH,Ie.width),I.pixelStorei(I.UNPACK_IMAGE_HEIGHT,Ie.height),I.pixelStorei(I.UNPACK_SKIP_PIXELS,Wt),I.pixelStorei(I.UNPACK_SKIP_ROWS,Jt),I.pixelStorei(I.UNPACK_SKIP_IMAGES,Zt),T.isDataTexture||T.isData3DTexture?I.texSubImage3D(Kt,K,qt,ge,Se,vt,Ct,Gt,pn,me,Ie.data):W.isCompressedArrayTexture?I.compressedTexSubImage3D(Kt,K,qt,ge,Se,vt,Ct,Gt,pn,Ie.data):I.texSubImage3D(Kt,K,qt,ge,Se,vt,Ct,Gt,pn,me,Ie),I.pixelStorei(I.UNPACK_ROW_LENGTH,Re),I.pixelStorei(I.UNPACK_IMAGE_HEIGHT,_e),I.pixelStorei(I.UNPACK_SKIP_PIXELS,In),I.pixelStorei(I.UNPACK_SKIP_ROWS,mi),I.pixelStorei(I.UNPACK_SKIP_IMAGES,xn),K===0&&W.generateMipmaps&&I.generateMipmap(Kt),At.unbindTexture()},this.initRenderTarget=function(T){Xt.get(T).__webglFramebuffer===void 0&&L.setupRenderTarget(T)},this.initTexture=function(T){T.isCubeTexture?L.setTextureCube(T,0):T.isData3DTexture?L.setTexture3D(T,0):T.isDataArrayTexture||T.isCompressedArrayTexture?L.setTexture2DArray(T,0):L.setTexture2D(T,0),At.unbindTexture()},this.resetState=function(){D=0,A=0,y=null,At.reset(),pe.reset()},typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}get coordinateSystem(){return zi}get outputColorSpace(){return this._outputColorSpace}set outputColorSpace(t){this._outputColorSpace=t;const e=this.getContext();e.drawingBufferColorSpace=t===Oh?"display-p3":"srgb",e.unpackColorSpace=ye.workingColorSpace===tl?"display-p3":"srgb"}}class Gy extends an{constructor(){super(),this.isScene=!0,this.type="Scene",this.background=null,this.environment=null,this.fog=null,this.backgroundBlurriness=0,this.backgroundIntensity=1,this.backgroundRotation=new Ai,this.environmentIntensity=1,this.environmentRotation=new Ai,this.overrideMaterial=null,typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}copy(t,e){return super.copy(t,e),t.background!==null&&(this.background=t.background.clone()),t.environment!==null&&(this.environment=t.environment.clone()),t.fog!==null&&(this.fog=t.fog.clone()),this.backgroundBlurriness=t.backgroundBlurriness,this.backgroundIntensity=t.backgroundIntensity,this.backgroundRotation.copy(t.backgroundRotation),this.environmentIntensity=t.environmentIntensity,this.environmentRotation.copy(t.environmentRotation),t.overrideMaterial!==null&&(this.overrideMaterial=t.overrideMaterial.clone()),this.matrixAutoUpdate=t.matrixAutoUpdate,this}toJSON(t){const e=super.toJSON(t);return this.fog!==null&&(e.object.fog=this.fog.toJSON()),this.backgroundBlurriness>0&&(e.object.backgroundBlurriness=this.backgroundBlurriness),this.backgroundIntensity!==1&&(e.object.backgroundIntensity=this.backgroundIntensity),e.object.backgroundRotation=this.backgroundRotation.toArray(),this.environmentIntensity!==1&&(e.object.environmentIntensity=this.environmentIntensity),e.object.environmentRotation=this.environmentRotation.toArray(),e}}class Vy{constructor(t,e){this.isInterleavedBuffer=!0,this.array=t,this.stride=e,this.count=t!==void 0?t.length/e:0,this.usage=uh,this.updateRanges=[],this.version=0,this.uuid=cs()}onUploadCallback(){}set needsUpdate(t){t===!0&&this.version++}setUsage(t){return this.usage=t,this}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}copy(t){return this.array=new t.array.constructor(t.array),this.count=t.count,this.stride=t.stride,this.usage=t.usage,this}copyAt(t,e,n){t*=this.stride,n*=e.stride;for(let s=0,r=this.stride;s<r;s++)this.array[t+s]=e.array[n+s];return this}set(t,e=0){return this.array.set(t,e),this}clone(t){t.arrayBuffers===void 0&&(t.arrayBuffers={}),this.array.buffer._uuid===void 0&&(this.array.buffer._uuid=cs()),t.arrayBuffers[this.array.buffer._uuid]===void 0&&(t.arrayBuffers[this.array.buffer._uuid]=this.array.slice(0).buffer);const e=new this.array.constructor(t.arrayBuffers[this.array.buffer._uuid]),n=new this.constructor(e,this.stride);return n.setUsage(this.usage),n}onUpload(t){return this.onUploadCallback=t,this}toJSON(t){return t.arrayBuffers===void 0&&(t.arrayBuffers={}),this.array.buffer._uuid===void 0&&(this.array.buffer._uuid=cs()),t.arrayBuffers[this.array.buffer._uuid]===void 0&&(t.arrayBuffers[this.array.buffer._uuid]=Array.from(new Uint32Array(this.array.buffer))),{uuid:this.uuid,buffer:this.array.buffer._uuid,type:this.array.constructor.name,stride:this.stride}}}const Rn=new j;class Xo{constructor(t,e,n,s=!1){this.isInterleavedBufferAttribute=!0,this.name="",this.data=t,this.itemSize=e,this.offset=n,this.normalized=s}get count(){return this.data.count}get array(){return this.data.array}set needsUpdate(t){this.data.needsUpdate=t}applyMatrix4(t){for(let e=0,n=this.data.count;e<n;e++)Rn.fromBufferAttribute(this,e),Rn.applyMatrix4(t),this.setXYZ(e,Rn.x,Rn.y,Rn.z);return this}applyNormalMatrix(t){for(let e=0,n=this.count;e<n;e++)Rn.fromBufferAttribute(this,e),Rn.applyNormalMatrix(t),this.setXYZ(e,Rn.x,Rn.y,Rn.z);return this}transformDirection(t){for(let e=0,n=this.count;e<n;e++)Rn.fromBufferAttribute(this,e),Rn.transformDirection(t),this.setXYZ(e,Rn.x,Rn.y,Rn.z);return this}getComponent(t,e){let n=this.array[t*this.data.stride+this.offset+e];return this.normalized&&(n=wi(n,this.array)),n}setComponent(t,e,n){return this.normalized&&(n=we(n,this.array)),this.data.array[t*this.data.stride+this.offset+e]=n,this}setX(t,e){return this.normalized&&(e=we(e,this.array)),this.data.array[t*this.data.stride+this.offset]=e,this}setY(t,e){return this.normalized&&(e=we(e,this.array)),this.data.array[t*this.data.stride+this.offset+1]=e,this}setZ(t,e){return this.normalized&&(e=we(e,this.array)),this.data.array[t*this.data.stride+this.offset+2]=e,this}setW(t,e){return this.normalized&&(e=we(e,this.array)),this.data.array[t*this.data.stride+this.offset+3]=e,this}getX(t){let e=this.data.array[t*this.data.stride+this.offset];return this.normalized&&(e=wi(e,this.array)),e}getY(t){let e=this.data.array[t*this.data.stride+this.offset+1];return this.normalized&&(e=wi(e,this.array)),e}getZ(t){let e=this.data.array[t*this.data.stride+this.offset+2];return this.normalized&&(e=wi(e,this.array)),e}getW(t){let e=this.data.array[t*this.data.stride+this.offset+3];return this.normalized&&(e=wi(e,this.array)),e}setXY(t,e,n){return t=t*this.data.stride+this.offset,this.normalized&&(e=we(e,this.array),n=we(n,this.array)),this.data.array[t+0]=e,this.data.array[t+1]=n,this}setXYZ(t,e,n,s){return t=t*this.data.stride+this.offset,this.normalized&&(e=we(e,this.array),n=we(n,this.array),s=we(s,this.array)),this.data.array[t+0]=e,this.data.array[t+1]=n,this.data.array[t+2]=s,this}setXYZW(t,e,n,s,r){return t=t*this.data.stride+this.offset,this.normalized&&(e=we(e,this.array),n=we(n,this.array),s=we(s,this.array),r=we(r,this.array)),this.data.array[t+0]=e,this.data.array[t+1]=n,this.data.array[t+2]=s,this.data.array[t+3]=r,this}clone(t){if(t===void 0){console.log("THREE.InterleavedBufferAttribute.clone(): Cloning an interleaved buffer attribute will de-interleave buffer data.");const e=[];for(let n=0;n<this.count;n++){const s=n*this.data.stride+this.offset;for(let r=0;r<this.itemSize;r++)e.push(this.data.array[s+r])}return new Wn(new this.array.constructor(e),this.itemSize,this.normalized)}else return t.interleavedBuffers===void 0&&(t.interleavedBuffers={}),t.interleavedBuffers[this.data.uuid]===void 0&&(t.interleavedBuffers[this.data.uuid]=this.data.clone(t)),new Xo(t.interleavedBuffers[this.data.uuid],this.itemSize,this.offset,this.normalized)}toJSON(t){if(t===void 0){console.log("THREE.InterleavedBufferAttribute.toJSON(): Serializing an interleaved buffer attribute will de-interleave buffer data.");const e=[];for(let n=0;n<this.count;n++){const s=n*this.data.stride+this.offset;for(let r=0;r<this.itemSize;r++)e.push(this.data.array[s+r])}return{itemSize:this.itemSize,type:this.array.constructor.name,array:e,normalized:this.normalized}}else return t.interleavedBuffers===void 0&&(t.interleavedBuffers={}),t.interleavedBuffers[this.data.uuid]===void 0&&(t.interleavedBuffers[this.data.uuid]=this.data.toJSON(t)),{isInterleavedBufferAttribute:!0,itemSize:this.itemSize,data:this.data.uuid,offset:this.offset,normalized:this.normalized}}}class Rp extends Gs{constructor(t){super(),this.isSpriteMaterial=!0,this.type="SpriteMaterial",this.color=new ne(16777215),this.map=null,this.alphaMap=null,this.rotation=0,this.sizeAttenuation=!0,this.transparent=!0,this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.alphaMap=t.alphaMap,this.rotation=t.rotation,this.sizeAttenuation=t.sizeAttenuation,this.fog=t.fog,this}}let _r;const ua=new j,vr=new j,xr=new j,Mr=new Qt,fa=new Qt,Cp=new Ge,ho=new j,da=new j,uo=new j,Df=new Qt,rc=new Qt,If=new Qt;class Wy extends an{constructor(t=new Rp){if(super(),this.isSprite=!0,this.type="Sprite",_r===void 0){_r=new gn;const e=new Float32Array([-.5,-.5,0,0,0,.5,-.5,0,1,0,.5,.5,0,1,1,-.5,.5,0,0,1]),n=new Vy(e,5);_r.setIndex([0,1,2,0,2,3]),_r.setAttribute("position",new Xo(n,3,0,!1)),_r.setAttribute("uv",new Xo(n,2,3,!1))}this.geometry=_r,this.material=t,this.center=new Qt(.5,.5)}raycast(t,e){t.camera===null&&console.error('THREE.Sprite: "Raycaster.camera" needs to be set in order to raycast against sprites.'),vr.setFromMatrixScale(this.matrixWorld),Cp.copy(t.camera.matrixWorld),this.modelViewMatrix.multiplyMatrices(t.camera.matrixWorldInverse,this.matrixWorld),xr.setFromMatrixPosition(this.modelViewMatrix),t.camera.isPerspectiveCamera&&this.material.sizeAttenuation===!1&&vr.multiplyScalar(-xr.z);const n=this.material.rotation;let s,r;n!==0&&(r=Math.cos(n),s=Math.sin(n));const a=this.center;fo(ho.set(-.5,-.5,0),xr,a,vr,s,r),fo(da.set(.5,-.5,0),xr,a,vr,s,r),fo(uo.set(.5,.5,0),xr,a,vr,s,r),Df.set(0,0),rc.set(1,0),If.set(1,1);let o=t.ray.intersectTriangle(ho,da,uo,!1,ua);if(o===null&&(fo(da.set(-.5,.5,0),xr,a,vr,s,r),rc.set(0,1),o=t.ray.intersectTriangle(ho,uo,da,!1,ua),o===null))return;const l=t.ray.origin.distanceTo(ua);l<t.near||l>t.far||e.push({distance:l,point:ua.clone(),uv:Vn.getInterpolation(ua,ho,da,uo,Df,rc,If,new Qt),face:null,object:this})}copy(t,e){return super.copy(t,e),t.center!==void 0&&this.center.copy(t.center),this.material=t.material,this}}function fo(i,t,e,n,s,r){Mr.subVectors(i,e).addScalar(.5).multiply(n),s!==void 0?(fa.x=r*Mr.x-s*Mr.y,fa.y=s*Mr.x+r*Mr.y):fa.copy(Mr),i.copy(t),i.x+=fa.x,i.y+=fa.y,i.applyMatrix4(Cp)}class Da extends Gs{constructor(t){super(),this.isLineBasicMaterial=!0,this.type="LineBasicMaterial",this.color=new ne(16777215),this.map=null,this.linewidth=1,this.linecap="round",this.linejoin="round",this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.linewidth=t.linewidth,this.linecap=t.linecap,this.linejoin=t.linejoin,this.fog=t.fog,this}}const qo=new j,Yo=new j,Uf=new Ge,pa=new Fh,po=new el,ac=new j,Nf=new j;class Hh extends an{constructor(t=new gn,e=new Da){super(),this.isLine=!0,this.type="Line",this.geometry=t,this.material=e,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}computeLineDistances(){const t=this.geometry;if(t.index===null){const e=t.attributes.position,n=[0];for(let s=1,r=e.count;s<r;s++)qo.fromBufferAttribute(e,s-1),Yo.fromBufferAttribute(e,s),n[s]=n[s-1],n[s]+=qo.distanceTo(Yo);t.setAttribute("lineDistance",new Be(n,1))}else console.warn("THREE.Line.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}raycast(t,e){const n=this.geometry,s=this.matrixWorld,r=t.params.Line.threshold,a=n.drawRange;if(n.boundingSphere===null&&n.computeBoundingSphere(),po.copy(n.boundingSphere),po.applyMatrix4(s),po.radius+=r,t.ray.intersectsSphere(po)===!1)return;Uf.copy(s).invert(),pa.copy(t.ray).applyMatrix4(Uf);const o=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=o*o,c=this.isLineSegments?2:1,u=n.index,h=n.attributes.position;if(u!==null){const _=Math.max(0,a.start),x=Math.min(u.count,a.start+a.count);for(let M=_,p=x-1;M<p;M+=c){const d=u.getX(M),C=u.getX(M+1),b=mo(this,t,pa,l,d,C);b&&e.push(b)}if(this.isLineLoop){const M=u.getX(x-1),p=u.getX(_),d=mo(this,t,pa,l,M,p);d&&e.push(d)}}else{const _=Math.max(0,a.start),x=Math.min(h.count,a.start+a.count);for(let M=_,p=x-1;M<p;M+=c){const d=mo(this,t,pa,l,M,M+1);d&&e.push(d)}if(this.isLineLoop){const M=mo(this,t,pa,l,x-1,_);M&&e.push(M)}}}updateMorphTargets(){const e=this.geometry.morphAttributes,n=Object.keys(e);if(n.length>0){const s=e[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,a=s.length;r<a;r++){const o=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[o]=r}}}}}function mo(i,t,e,n,s,r){const a=i.geometry.attributes.position;if(qo.fromBufferAttribute(a,s),Yo.fromBufferAttribute(a,r),e.distanceSqToSegment(qo,Yo,ac,Nf)>n)return;ac.applyMatrix4(i.matrixWorld);const l=t.ray.origin.distanceTo(ac);if(!(l<t.near||l>t.far))return{distance:l,point:Nf.clone().applyMatrix4(i.matrixWorld),index:s,face:null,faceIndex:null,barycoord:null,object:i}}const kf=new j,Of=new j;class Gh extends Hh{constructor(t,e){super(t,e),this.isLineSegments=!0,this.type="LineSegments"}computeLineDistances(){const t=this.geometry;if(t.index===null){const e=t.attributes.position,n=[];for(let s=0,r=e.count;s<r;s+=2)kf.fromBufferAttribute(e,s),Of.fromBufferAttribute(e,s+1),n[s]=s===0?0:n[s-1],n[s+1]=n[s]+kf.distanceTo(Of);t.setAttribute("lineDistance",new Be(n,1))}else console.warn("THREE.LineSegments.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}}class Xy extends Ln{constructor(t,e,n,s,r,a,o,l,c){super(t,e,n,s,r,a,o,l,c),this.isCanvasTexture=!0,this.needsUpdate=!0}}class sl extends gn{constructor(t=1,e=1,n=1,s=32,r=1,a=!1,o=0,l=Math.PI*2){super(),this.type="CylinderGeometry",this.parameters={radiusTop:t,radiusBottom:e,height:n,radialSegments:s,heightSegments:r,openEnded:a,thetaStart:o,thetaLength:l};const c=this;s=Math.floor(s),r=Math.floor(r);const u=[],f=[],h=[],_=[];let x=0;const M=[],p=n/2;let d=0;C(),a===!1&&(t>0&&b(!0),e>0&&b(!1)),this.setIndex(u),this.setAttribute("position",new Be(f,3)),this.setAttribute("normal",new Be(h,3)),this.setAttribute("uv",new Be(_,2));function C(){const R=new j,D=new j;let A=0;const y=(e-t)/n;for(let P=0;P<=r;P++){const O=[],g=P/r,m=g*(e-t)+t;for(let E=0;E<=s;E++){const N=E/s,F=N*l+o,B=Math.sin(F),G=Math.cos(F);D.x=m*B,D.y=-g*n+p,D.z=m*G,f.push(D.x,D.y,D.z),R.set(B,y,G).normalize(),h.push(R.x,R.y,R.z),_.push(N,1-g),O.push(x++)}M.push(O)}for(let P=0;P<s;P++)for(let O=0;O<r;O++){const g=M[O][P],m=M[O+1][P],E=M[O+1][P+1],N=M[O][P+1];t>0&&(u.push(g,m,N),A+=3),e>0&&(u.push(m,E,N),A+=3)}c.addGroup(d,A,0),d+=A}function b(R){const D=x,A=new Qt,y=new j;let P=0;const O=R===!0?t:e,g=R===!0?1:-1;for(let E=1;E<=s;E++)f.push(0,p*g,0),h.push(0,g,0),_.push(.5,.5),x++;const m=x;for(let E=0;E<=s;E++){const F=E/s*l+o,B=Math.cos(F),G=Math.sin(F);y.x=O*G,y.y=p*g,y.z=O*B,f.push(y.x,y.y,y.z),h.push(0,g,0),A.x=B*.5+.5,A.y=G*.5*g+.5,_.push(A.x,A.y),x++}for(let E=0;E<s;E++){const N=D+E,F=m+E;R===!0?u.push(F,F+1,N):u.push(F+1,F,N),P+=3}c.addGroup(d,P,R===!0?1:2),d+=P}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new sl(t.radiusTop,t.radiusBottom,t.height,t.radialSegments,t.heightSegments,t.openEnded,t.thetaStart,t.thetaLength)}}const go=new j,_o=new j,oc=new j,vo=new Vn;class qy extends gn{constructor(t=null,e=1){if(super(),this.type="EdgesGeometry",this.parameters={geometry:t,thresholdAngle:e},t!==null){const s=Math.pow(10,4),r=Math.cos(Sa*e),a=t.getIndex(),o=t.getAttribute("position"),l=a?a.count:o.count,c=[0,0,0],u=["a","b","c"],f=new Array(3),h={},_=[];for(let x=0;x<l;x+=3){a?(c[0]=a.getX(x),c[1]=a.getX(x+1),c[2]=a.getX(x+2)):(c[0]=x,c[1]=x+1,c[2]=x+2);const{a:M,b:p,c:d}=vo;if(M.fromBufferAttribute(o,c[0]),p.fromBufferAttribute(o,c[1]),d.fromBufferAttribute(o,c[2]),vo.getNormal(oc),f[0]=`${Math.round(M.x*s)},${Math.round(M.y*s)},${Math.round(M.z*s)}`,f[1]=`${Math.round(p.x*s)},${Math.round(p.y*s)},${Math.round(p.z*s)}`,f[2]=`${Math.round(d.x*s)},${Math.round(d.y*s)},${Math.round(d.z*s)}`,!(f[0]===f[1]||f[1]===f[2]||f[2]===f[0]))for(let C=0;C<3;C++){const b=(C+1)%3,R=f[C],D=f[b],A=vo[u[C]],y=vo[u[b]],P=`${R}_${D}`,O=`${D}_${R}`;O in h&&h[O]?(oc.dot(h[O].normal)<=r&&(_.push(A.x,A.y,A.z),_.push(y.x,y.y,y.z)),h[O]=null):P in h||(h[P]={index0:c[C],index1:c[b],normal:oc.clone()})}}for(const x in h)if(h[x]){const{index0:M,index1:p}=h[x];go.fromBufferAttribute(o,M),_o.fromBufferAttribute(o,p),_.push(go.x,go.y,go.z),_.push(_o.x,_o.y,_o.z)}this.setAttribute("position",new Be(_,3))}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}}class rl extends gn{constructor(t=.5,e=1,n=32,s=1,r=0,a=Math.PI*2){super(),this.type="RingGeometry",this.parameters={innerRadius:t,outerRadius:e,thetaSegments:n,phiSegments:s,thetaStart:r,thetaLength:a},n=Math.max(3,n),s=Math.max(1,s);const o=[],l=[],c=[],u=[];let f=t;const h=(e-t)/s,_=new j,x=new Qt;for(let M=0;M<=s;M++){for(let p=0;p<=n;p++){const d=r+p/n*a;_.x=f*Math.cos(d),_.y=f*Math.sin(d),l.push(_.x,_.y,_.z),c.push(0,0,1),x.x=(_.x/e+1)/2,x.y=(_.y/e+1)/2,u.push(x.x,x.y)}f+=h}for(let M=0;M<s;M++){const p=M*(n+1);for(let d=0;d<n;d++){const C=d+p,b=C,R=C+n+1,D=C+n+2,A=C+1;o.push(b,R,A),o.push(R,D,A)}}this.setIndex(o),this.setAttribute("position",new Be(l,3)),this.setAttribute("normal",new Be(c,3)),this.setAttribute("uv",new Be(u,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new rl(t.innerRadius,t.outerRadius,t.thetaSegments,t.phiSegments,t.thetaStart,t.thetaLength)}}class al extends gn{constructor(t=1,e=32,n=16,s=0,r=Math.PI*2,a=0,o=Math.PI){super(),this.type="SphereGeometry",this.parameters={radius:t,widthSegments:e,heightSegments:n,phiStart:s,phiLength:r,thetaStart:a,thetaLength:o},e=Math.max(3,Math.floor(e)),n=Math.max(2,Math.floor(n));const l=Math.min(a+o,Math.PI);let c=0;const u=[],f=new j,h=new j,_=[],x=[],M=[],p=[];for(let d=0;d<=n;d++){const C=[],b=d/n;let R=0;d===0&&a===0?R=.5/e:d===n&&l===Math.PI&&(R=-.5/e);for(let D=0;D<=e;D++){const A=D/e;f.x=-t*Math.cos(s+A*r)*Math.sin(a+b*o),f.y=t*Math.cos(a+b*o),f.z=t*Math.sin(s+A*r)*Math.sin(a+b*o),x.push(f.x,f.y,f.z),h.copy(f).normalize(),M.push(h.x,h.y,h.z),p.push(A+R,1-b),C.push(c++)}u.push(C)}for(let d=0;d<n;d++)for(let C=0;C<e;C++){const b=u[d][C+1],R=u[d][C],D=u[d+1][C],A=u[d+1][C+1];(d!==0||a>0)&&_.push(b,R,A),(d!==n-1||l<Math.PI)&&_.push(R,D,A)}this.setIndex(_),this.setAttribute("position",new Be(x,3)),this.setAttribute("normal",new Be(M,3)),this.setAttribute("uv",new Be(p,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new al(t.radius,t.widthSegments,t.heightSegments,t.phiStart,t.phiLength,t.thetaStart,t.thetaLength)}}class Vh extends gn{constructor(t=1,e=.4,n=12,s=48,r=Math.PI*2){super(),this.type="TorusGeometry",this.parameters={radius:t,tube:e,radialSegments:n,tubularSegments:s,arc:r},n=Math.floor(n),s=Math.floor(s);const a=[],o=[],l=[],c=[],u=new j,f=new j,h=new j;for(let _=0;_<=n;_++)for(let x=0;x<=s;x++){const M=x/s*r,p=_/n*Math.PI*2;f.x=(t+e*Math.cos(p))*Math.cos(M),f.y=(t+e*Math.cos(p))*Math.sin(M),f.z=e*Math.sin(p),o.push(f.x,f.y,f.z),u.x=t*Math.cos(M),u.y=t*Math.sin(M),h.subVectors(f,u).normalize(),l.push(h.x,h.y,h.z),c.push(x/s),c.push(_/n)}for(let _=1;_<=n;_++)for(let x=1;x<=s;x++){const M=(s+1)*_+x-1,p=(s+1)*(_-1)+x-1,d=(s+1)*(_-1)+x,C=(s+1)*_+x;a.push(M,p,C),a.push(p,d,C)}this.setIndex(a),this.setAttribute("position",new Be(o,3)),this.setAttribute("normal",new Be(l,3)),this.setAttribute("uv",new Be(c,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new Vh(t.radius,t.tube,t.radialSegments,t.tubularSegments,t.arc)}}class Wh extends Gs{constructor(t){super(),this.isMeshLambertMaterial=!0,this.type="MeshLambertMaterial",this.color=new ne(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.emissive=new ne(0),this.emissiveIntensity=1,this.emissiveMap=null,this.bumpMap=null,this.bumpScale=1,this.normalMap=null,this.normalMapType=cp,this.normalScale=new Qt(1,1),this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new Ai,this.combine=Ph,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.flatShading=!1,this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.emissive.copy(t.emissive),this.emissiveMap=t.emissiveMap,this.emissiveIntensity=t.emissiveIntensity,this.bumpMap=t.bumpMap,this.bumpScale=t.bumpScale,this.normalMap=t.normalMap,this.normalMapType=t.normalMapType,this.normalScale.copy(t.normalScale),this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.combine=t.combine,this.reflectivity=t.reflectivity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.flatShading=t.flatShading,this.fog=t.fog,this}}class Pp extends an{constructor(t,e=1){super(),this.isLight=!0,this.type="Light",this.color=new ne(t),this.intensity=e}dispose(){}copy(t,e){return super.copy(t,e),this.color.copy(t.color),this.intensity=t.intensity,this}toJSON(t){const e=super.toJSON(t);return e.object.color=this.color.getHex(),e.object.intensity=this.intensity,this.groundColor!==void 0&&(e.object.groundColor=this.groundColor.getHex()),this.distance!==void 0&&(e.object.distance=this.distance),this.angle!==void 0&&(e.object.angle=this.angle),this.decay!==void 0&&(e.object.decay=this.decay),this.penumbra!==void 0&&(e.object.penumbra=this.penumbra),this.shadow!==void 0&&(e.object.shadow=this.shadow.toJSON()),this.target!==void 0&&(e.object.target=this.target.uuid),e}}const lc=new Ge,Ff=new j,Bf=new j;class Yy{constructor(t){this.camera=t,this.intensity=1,this.bias=0,this.normalBias=0,this.radius=1,this.blurSamples=8,this.mapSize=new Qt(512,512),this.map=null,this.mapPass=null,this.matrix=new Ge,this.autoUpdate=!0,this.needsUpdate=!1,this._frustum=new Bh,this._frameExtents=new Qt(1,1),this._viewportCount=1,this._viewports=[new je(0,0,1,1)]}getViewportCount(){return this._viewportCount}getFrustum(){return this._frustum}updateMatrices(t){const e=this.camera,n=this.matrix;Ff.setFromMatrixPosition(t.matrixWorld),e.position.copy(Ff),Bf.setFromMatrixPosition(t.target.matrixWorld),e.lookAt(Bf),e.updateMatrixWorld(),lc.multiplyMatrices(e.projectionMatrix,e.matrixWorldInverse),this._frustum.setFromProjectionMatrix(lc),n.set(.5,0,0,.5,0,.5,0,.5,0,0,.5,.5,0,0,0,1),n.multiply(lc)}getViewport(t){return this._viewports[t]}getFrameExtents(){return this._frameExtents}dispose(){this.map&&this.map.dispose(),this.mapPass&&this.mapPass.dispose()}copy(t){return this.camera=t.camera.clone(),this.intensity=t.intensity,this.bias=t.bias,this.radius=t.radius,this.mapSize.copy(t.mapSize),this}clone(){return new this.constructor().copy(this)}toJSON(){const t={};return this.intensity!==1&&(t.intensity=this.intensity),this.bias!==0&&(t.bias=this.bias),this.normalBias!==0&&(t.normalBias=this.normalBias),this.radius!==1&&(t.radius=this.radius),(this.mapSize.x!==512||this.mapSize.y!==512)&&(t.mapSize=this.mapSize.toArray()),t.camera=this.camera.toJSON(!1).object,delete t.camera.matrix,t}}class jy extends Yy{constructor(){super(new Sp(-5,5,5,-5,.5,500)),this.isDirectionalLightShadow=!0}}class Ky extends Pp{constructor(t,e){super(t,e),this.isDirectionalLight=!0,this.type="DirectionalLight",this.position.copy(an.DEFAULT_UP),this.updateMatrix(),this.target=new an,this.shadow=new jy}dispose(){this.shadow.dispose()}copy(t){return super.copy(t),this.target=t.target.clone(),this.shadow=t.shadow.clone(),this}}class $y extends Pp{constructor(t,e){super(t,e),this.isAmbientLight=!0,this.type="AmbientLight"}}class zf{constructor(t=1,e=0,n=0){return this.radius=t,this.phi=e,this.theta=n,this}set(t,e,n){return this.radius=t,this.phi=e,this.theta=n,this}copy(t){return this.radius=t.radius,this.phi=t.phi,this.theta=t.theta,this}makeSafe(){return this.phi=Math.max(1e-6,Math.min(Math.PI-1e-6,this.phi)),this}setFromVector3(t){return this.setFromCartesianCoords(t.x,t.y,t.z)}setFromCartesianCoords(t,e,n){return this.radius=Math.sqrt(t*t+e*e+n*n),this.radius===0?(this.theta=0,this.phi=0):(this.theta=Math.atan2(t,n),this.phi=Math.acos(Pn(e/this.radius,-1,1))),this}clone(){return new this.constructor().copy(this)}}class Zy extends Gh{constructor(t=10,e=10,n=4473924,s=8947848){n=new ne(n),s=new ne(s);const r=e/2,a=t/e,o=t/2,l=[],c=[];for(let h=0,_=0,x=-o;h<=e;h++,x+=a){l.push(-o,0,x,o,0,x),l.push(x,0,-o,x,0,o);const M=h===r?n:s;M.toArray(c,_),_+=3,M.toArray(c,_),_+=3,M.toArray(c,_),_+=3,M.toArray(c,_),_+=3}const u=new gn;u.setAttribute("position",new Be(l,3)),u.setAttribute("color",new Be(c,3));const f=new Da({vertexColors:!0,toneMapped:!1});super(u,f),this.type="GridHelper"}dispose(){this.geometry.dispose(),this.material.dispose()}}const Hf=new j;let xo,cc;class Jy extends an{constructor(t=new j(0,0,1),e=new j(0,0,0),n=1,s=16776960,r=n*.2,a=r*.2){super(),this.type="ArrowHelper",xo===void 0&&(xo=new gn,xo.setAttribute("position",new Be([0,0,0,0,1,0],3)),cc=new sl(0,.5,1,5,1),cc.translate(0,-.5,0)),this.position.copy(e),this.line=new Hh(xo,new Da({color:s,toneMapped:!1})),this.line.matrixAutoUpdate=!1,this.add(this.line),this.cone=new rn(cc,new Xr({color:s,toneMapped:!1})),this.cone.matrixAutoUpdate=!1,this.add(this.cone),this.setDirection(t),this.setLength(n,r,a)}setDirection(t){if(t.y>.99999)this.quaternion.set(0,0,0,1);else if(t.y<-.99999)this.quaternion.set(1,0,0,0);else{Hf.set(t.z,0,-t.x).normalize();const e=Math.acos(t.y);this.quaternion.setFromAxisAngle(Hf,e)}}setLength(t,e=t*.2,n=e*.2){this.line.scale.set(1,Math.max(1e-4,t-e),1),this.line.updateMatrix(),this.cone.scale.set(n,e,n),this.cone.position.y=t,this.cone.updateMatrix()}setColor(t){this.line.material.color.set(t),this.cone.material.color.set(t)}copy(t){return super.copy(t,!1),this.line.copy(t.line),this.cone.copy(t.cone),this}dispose(){this.line.geometry.dispose(),this.line.material.dispose(),this.cone.geometry.dispose(),this.cone.material.dispose()}}class Qy extends Hs{constructor(t,e=null){super(),this.object=t,this.domElement=e,this.enabled=!0,this.state=-1,this.keys={},this.mouseButtons={LEFT:null,MIDDLE:null,RIGHT:null},this.touches={ONE:null,TWO:null}}connect(){}disconnect(){}dispose(){}update(){}}typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("register",{detail:{revision:Ch}}));typeof window<"u"&&(window.__THREE__?console.warn("WARNING: Multiple instances of Three.js being imported."):window.__THREE__=Ch);const hc=["#0072b2","#e69f00","#009e73","#cc79a7","#56b4e9","#d55e00","#8b6bd6","#7a8b00"];function jo(i){return hc[i%hc.length]??hc[0]}function Gf(i){const t=getComputedStyle(i),e=(n,s)=>t.getPropertyValue(n).trim()||s;return{background:new ne(e("--picture","#eef2f5")),grid:new ne(e("--picture-grid","#c3ccd4")),wall:new ne(e("--picture-wall","#8b98a5")),tissue:new ne(e("--picture-tissue","#d98a86")),tool:new ne(e("--picture-tool","#33414e")),contact:new ne(e("--picture-contact","#c2410c")),limit:new ne(e("--red","#b42318")),text:e("--text","#16212b"),label:e("--surface","#ffffff")}}const Vf=i=>i===null?Ti:i.map(t=>nn(t*1e3,1)).join(" "),Wf=i=>i===null?Ti:nn(Math.hypot(...i),2);function ol(i){return Ei("svg",{class:"swatch",viewBox:"0 0 10 10","aria-hidden":"true"},Ei("rect",{width:10,height:10,rx:3,fill:jo(i)}))}class tS{constructor(t,e){this.page=t,this.slot=z("div",{class:"slot large"}),this.rows=z("tbody"),this.cells=[],this.known=null,this.camera=ii([],"free",r=>e?.rig.choose(r));const n=r=>wc(H(`picture.${r}`),e?.options[r]??!1,a=>{e&&(e.options[r]=a)}),s=["what","position","force","authority"].map(r=>z("th",{scope:"col"},H(`values.${r}`)));this.node=z("div",{class:"view live-view"},this.slot,z("div",{class:"side"},qn(H("picture.camera"),"camera-panel",Ye(H("picture.camera"),this.camera),z("div",{class:"checks"},n("trails"),n("forces"),n("names"))),qn(H("picture.values"),"values-panel",z("div",{class:"scroll",tabindex:0,role:"region","aria-label":H("picture.values")},z("table",{},z("thead",{},z("tr",{},...s)),this.rows)))))}shown(){this.slot.append(this.page.pictureHost)}update(){const{scene:t,state:e}=this.page.model;if(!t||!e)return;t!==this.known&&this.adopt(t);const n=t.seats.flatMap((s,r)=>s.kind==="MASTER"?[r]:[]);e.seats.forEach((s,r)=>{const a=n.indexOf(r),o=a<0?[]:e.tools.map(l=>Er(l.applied?.[a]));this.set(r,[Vf(s.x),Wf(s.f),o.join(" · ")||Ti])}),e.tools.forEach((s,r)=>{const a=s.touching?H("values.depth",{mm:nn((s.depth_m??NaN)*1e3,1,"mm")}):"";this.set(t.seats.length+r,[Vf(s.x),Wf(s.f),a])})}set(t,e){e.forEach((n,s)=>{const r=this.cells[t]?.[s];r&&Ae(r,n)})}adopt(t){this.known=t;const e=t.seats.flatMap((s,r)=>s.kind==="MASTER"?[[`seat:${r}`,s.name]]:[]);ks(this.camera,[["free",H("camera.free")],["front",H("camera.front")],["above",H("camera.above")],...e.map(([s,r])=>[s,H("camera.seat",{seat:r})])],this.camera.value||"free");const n=[...t.seats.map((s,r)=>[ol(r),s.name]),...t.tools.map(s=>[null,s.name])];this.cells=n.map(()=>[z("td"),z("td"),z("td")]),this.rows.replaceChildren(...n.map(([s,r],a)=>z("tr",{},z("th",{scope:"row"},s,r),...this.cells[a]??[])))}}class eS{constructor(t){this.page=t,this.tools=ii([["0",""]],"0",()=>this.discard()),this.rows=z("div",{class:"shares"}),this.presets=z("div",{class:"row presets"}),this.to=ii([],"",()=>{}),this.share=z("input",{type:"number",min:5,max:100,step:5,value:"100"}),this.transfer=z("p",{class:"transfer",role:"status"}),this.draftNote=z("p",{class:"note"}),this.sliders=[],this.masters=[],this.known=null,this.draft=null,this.apply=He(H("authority.apply"),()=>this.send(H("authority.title"),this.draft),{class:"primary"}),this.reset=He(H("authority.reset"),()=>this.discard()),this.give=He(H("authority.give"),()=>this.handOver()),this.node=qn(H("authority.title"),"authority-panel",Ye(H("authority.tool",{tool:""}).trim(),this.tools),this.rows,z("div",{class:"row"},this.apply,this.reset,this.draftNote),z("h3",{},H("authority.presets")),this.presets,z("h3",{},H("authority.hand_over")),z("div",{class:"row"},Ye(H("authority.hand_over"),this.to),Ye(`${H("authority.share")} (%)`,this.share),this.give),this.transfer,z("p",{class:"note"},H("authority.explain",{ticks:Lg})))}update(){const{model:t}=this.page;t.scene&&t.scene!==this.known&&this.adopt(t.scene);const e=t.state?.tools[this.tool()],n=e?.wanted??null,s=e?.applied??null;Ig(this.draft,n)&&(this.draft=null);const r=t.may("authority")&&n!==null;this.sliders.forEach((o,l)=>{const c=(this.draft??n)?.[l];(this.draft===null&&document.activeElement!==o.slider&&c!==void 0||this.draft!==null&&c!==void 0)&&(o.slider.value=String(Math.round(c*100))),o.slider.setAttribute("aria-valuetext",Er(c)),Ae(o.draft,Er(c)),Ae(o.wanted,Er(n?.[l])),Ae(o.applied,Er(s?.[l])),o.bar.value=s?.[l]??0,be(o.slider,!r)}),Ae(this.draftNote,this.draft?H("authority.draft"):""),be(this.apply,!r||this.draft===null),be(this.reset,this.draft===null),be(this.give,!r||this.masters.length<2),be(this.to,!r),be(this.share,!r),be(this.tools,this.tools.options.length<2);for(const o of this.presets.children)be(o,!r);const a=e?.transfer??null;Ae(this.transfer,a?H("authority.transfer",{by:a.by,to:a.to,alpha:Er(a.alpha),ticks:a.ticks??Ti}):H("authority.no_transfer")),this.transfer.classList.toggle("announced",a!==null)}tool(){return Number(this.tools.value)||0}discard(){this.draft=null,this.update()}handOver(){const t=Number(this.to.value),e=Math.min(100,Math.max(0,Number(this.share.value)))/100,n=this.page.model.state?.tools[this.tool()]?.wanted;!n||Number.isNaN(e)||this.send(H("authority.give"),ku(n,t,e))}send(t,e){const n=this.page.model.state?.version;!e||n===void 0||this.page.order(t,{order:"authority",tool:this.tool(),version:n,alpha:e}).then(s=>{s.ok&&(this.draft=null)})}adopt(t){this.known=t,this.draft=null,this.masters=Yd(t),ks(this.tools,t.tools.map((r,a)=>[String(a),r.name]),this.tools.value);const e=Rh(this.masters);ks(this.to,this.masters.map((r,a)=>[String(a),r.name]),String(Bo(this.masters)[0]??0)),this.sliders=[],this.rows.replaceChildren(z("div",{class:"share head","aria-hidden":"true"},z("span"),z("span"),z("span"),z("span",{},H("authority.wanted")),z("span",{},H("authority.applied"))),...this.masters.map((r,a)=>this.row(r,a,t)));const n=r=>()=>this.preset(jd(this.masters.length,r)),s=H("authority.demonstration");this.presets.replaceChildren(He(s,n(e)),He(H("authority.guidance"),()=>this.preset(Dg(this.masters))),...Bo(this.masters).map(r=>He(H("authority.evaluation",{seat:this.masters[r]?.name??""}),n(r))))}preset(t){this.send(H("authority.presets"),t)}row(t,e,n){const s=z("input",{type:"range",min:0,max:100,step:5,"aria-label":H("authority.share_of",{seat:t.name}),oninput:()=>{const u=this.draft??this.page.model.state?.tools[this.tool()]?.wanted;u&&(this.draft=ku(u,e,Number(s.value)/100)),this.update()}}),r=z("progress",{max:1,"aria-label":`${t.name}: ${H("authority.applied")}`}),[a,o,l]=[z("span",{class:"draft"}),z("span"),z("span")];this.sliders.push({slider:s,draft:a,wanted:o,applied:l,bar:r});const c=u=>z("span",{class:"visually-hidden"},`${u}: `);return z("div",{class:"share"},z("span",{class:"name"},ol(n.seats.indexOf(t)),t.name),s,a,z("span",{class:"number"},c(H("authority.wanted")),o),z("span",{class:"number applied"},c(H("authority.applied")),l,r))}}const Lp={green:20,amber:100},Xh={green:5,amber:50},Dp={green:.1,amber:10},nS=Xh,iS=.8,sS=.999,Xf=["unknown","green","amber","red"];function Is(i,t){return i===null||!Number.isFinite(i)?"unknown":i<=t.green?"green":i<=t.amber?"amber":"red"}function Ip(i){return i.reduce((t,e)=>Xf.indexOf(e)>Xf.indexOf(t)?e:t,"unknown")}function qh(i){return i.f===null?null:Math.hypot(...i.f)}function Yh(i,t){const e=qh(i),n=t?.force_limit_n??null;return e===null||n===null||!(n>0)?null:e/n}function Up(i){return i===null?"unknown":i>=sS?"red":i>=iS?"amber":"green"}function jh(i,t){return Up(Yh(i,t))==="red"}function Np(i){return i===null?"unknown":i>.005?"green":i>0?"amber":"red"}function kp(i){return i===null?"unknown":i==="LATCHED"||i==="FAULT"?"red":i==="ON"?"green":"amber"}function Op(i){return i===null?"unknown":i<50?"green":i<65?"amber":"red"}function ph(i){return Ip([Is(i.rtt_ms,Lp),Is(i.loss_percent,Dp),Is(i.gap_ms,Xh)])}class Ra{constructor(t){if(this.capacity=t,this.entries=[],this.begin=0,!Number.isInteger(t)||t<1)throw new RangeError(`capacity ${t}: allowed are integers >= 1`)}get length(){return this.entries.length-this.begin}get newest(){return this.length>0?this.entries[this.entries.length-1]:void 0}push(t){this.entries.push(t),this.length>this.capacity&&(this.begin+=1),this.compact()}dropWhile(t){for(let e=this.entries[this.begin];e!==void 0&&t(e);e=this.entries[this.begin])this.begin+=1;this.compact()}at(t){return t<0?void 0:this.entries[this.begin+t]}clear(){this.entries=[],this.begin=0}toArray(){return this.entries.slice(this.begin)}compact(){this.begin<=this.capacity||(this.entries=this.entries.slice(this.begin),this.begin=0)}}const mh=60,Mo=4,Fp=["force","rtt","loss","margin"],ma={force:qh,rtt:i=>i.rtt_ms,loss:i=>i.loss_percent,margin:i=>i.margin_j};class rS{constructor(){this.rows=null,this.ring=new Ra(mh*Mo)}clear(){this.ring.clear(),this.rows=null}update(t,e){if(e&&e.seats.length!==t.seats.length)return;const n=Math.floor(t.t*Mo);if(this.rows&&(n<Math.floor(this.rows.t*Mo)||this.rows.seats.length!==t.seats.length)&&this.clear(),this.rows&&Math.floor(this.rows.t*Mo)===n){const s=this.rows;t.seats.forEach((r,a)=>{const o=s.seats[a];if(o)for(const l of Fp)o[l]=aS(l,o[l],ma[l](r))});return}this.rows={t:t.t,seats:t.seats.map(s=>({force:ma.force(s),rtt:ma.rtt(s),loss:ma.loss(s),margin:ma.margin(s)}))},this.ring.push(this.rows),this.ring.dropWhile(s=>t.t-s.t>mh)}get samples(){return this.ring.length}series(t,e){const n=this.ring.newest?.t??0,s=this.ring.toArray();return[s.map(r=>r.t-n),s.map(r=>r.seats[t]?.[e]??null)]}}function aS(i,t,e){return t===null||e===null?t??e:i==="margin"?Math.min(t,e):Math.max(t,e)}const oS=!0,cn="u-",lS="uplot",cS=cn+"hz",hS=cn+"vt",uS=cn+"title",fS=cn+"wrap",dS=cn+"under",pS=cn+"over",mS=cn+"axis",Ps=cn+"off",gS=cn+"select",_S=cn+"cursor-x",vS=cn+"cursor-y",xS=cn+"cursor-pt",MS=cn+"legend",yS=cn+"live",SS=cn+"inline",ES=cn+"series",wS=cn+"marker",qf=cn+"label",bS=cn+"value",xa="width",Ma="height",ga="top",Yf="bottom",yr="left",uc="right",Kh="#000",jf=Kh+"0",Kf="mousemove",$f="mousedown",fc="mouseup",Zf="mouseenter",Jf="mouseleave",Qf="dblclick",TS="resize",AS="scroll",td="change",Ko="dppxchange",$h="--",jr=typeof window<"u",gh=jr?document:null,Ir=jr?window:null,RS=jr?navigator:null;let xe,yo;function _h(){let i=devicePixelRatio;xe!=i&&(xe=i,yo&&xh(td,yo,_h),yo=matchMedia(`(min-resolution: ${xe-.001}dppx) and (max-resolution: ${xe+.001}dppx)`),Ns(td,yo,_h),Ir.dispatchEvent(new CustomEvent(Ko)))}function Hn(i,t){if(t!=null){let e=i.classList;!e.contains(t)&&e.add(t)}}function vh(i,t){let e=i.classList;e.contains(t)&&e.remove(t)}function Oe(i,t,e){i.style[t]=e+"px"}function hi(i,t,e,n){let s=gh.createElement(i);return t!=null&&Hn(s,t),e?.insertBefore(s,n),s}function Zn(i,t){return hi("div",i,t)}const ed=new WeakMap;function Mi(i,t,e,n,s){let r="translate("+t+"px,"+e+"px)",a=ed.get(i);r!=a&&(i.style.transform=r,ed.set(i,r),t<0||e<0||t>n||e>s?Hn(i,Ps):vh(i,Ps))}const nd=new WeakMap;function id(i,t,e){let n=t+e,s=nd.get(i);n!=s&&(nd.set(i,n),i.style.background=t,i.style.borderColor=e)}const sd=new WeakMap;function rd(i,t,e,n){let s=t+""+e,r=sd.get(i);s!=r&&(sd.set(i,s),i.style.height=e+"px",i.style.width=t+"px",i.style.marginLeft=n?-t/2+"px":0,i.style.marginTop=n?-e/2+"px":0)}const Zh={passive:!0},CS={...Zh,capture:!0};function Ns(i,t,e,n){t.addEventListener(i,e,n?CS:Zh)}function xh(i,t,e,n){t.removeEventListener(i,e,Zh)}jr&&_h();function ui(i,t,e,n){let s;e=e||0,n=n||t.length-1;let r=n<=2147483647;for(;n-e>1;)s=r?e+n>>1:Xn((e+n)/2),t[s]<i?e=s:n=s;return i-t[e]<=t[n]-i?e:n}function zr(i,t,e,n){for(let s=n==1?t:e;s>=t&&s<=e;s+=n)if(i[s]!=null)return s;return-1}function PS(i,t,e,n){let s=ue,r=-ue;if(n==1)s=i[t],r=i[e];else if(n==-1)s=i[e],r=i[t];else for(let a=t;a<=e;a++){let o=i[a];o!=null&&(o<s&&(s=o),o>r&&(r=o))}return[s,r]}function LS(i,t,e){let n=ue,s=-ue;for(let r=t;r<=e;r++){let a=i[r];a!=null&&a>0&&(a<n&&(n=a),a>s&&(s=a))}return[n,s]}function ll(i,t,e,n){let s=ld(i),r=ld(t);i==t&&(s==-1?(i*=e,t/=e):(i/=e,t*=e));let a=e==10?Hi:Bp,o=s==1?Xn:Jn,l=r==1?Jn:Xn,c=o(a(sn(i))),u=l(a(sn(t))),f=Hr(e,c),h=Hr(e,u);return e==10&&(c<0&&(f=Le(f,-c)),u<0&&(h=Le(h,-u))),n||e==2?(i=f*s,t=h*r):(i=Gp(i,f),t=cl(t,h)),[i,t]}function Jh(i,t,e,n){let s=ll(i,t,e,n);return i==0&&(s[0]=0),t==0&&(s[1]=0),s}const Qh=.1,ad={mode:3,pad:Qh},Ea={pad:0,soft:null,mode:0},DS={min:Ea,max:Ea};function $o(i,t,e,n){return hl(e)?od(i,t,e):(Ea.pad=e,Ea.soft=n?0:null,Ea.mode=n?3:0,od(i,t,DS))}function ve(i,t){return i??t}function IS(i,t,e){for(t=ve(t,0),e=ve(e,i.length-1);t<=e;){if(i[t]!=null)return!0;t++}return!1}function od(i,t,e){let n=e.min,s=e.max,r=ve(n.pad,0),a=ve(s.pad,0),o=ve(n.hard,-ue),l=ve(s.hard,ue),c=ve(n.soft,ue),u=ve(s.soft,-ue),f=ve(n.mode,0),h=ve(s.mode,0),_=t-i,x=Hi(_),M=Sn(sn(i),sn(t)),p=Hi(M),d=sn(p-x);(_<1e-24||d>10)&&(_=0,(i==0||t==0)&&(_=1e-24,f==2&&c!=ue&&(r=0),h==2&&u!=-ue&&(a=0)));let C=_||M||1e3,b=Hi(C),R=Hr(10,Xn(b)),D=C*(_==0?i==0?.1:1:r),A=Le(Gp(i-D,R/10),24),y=i>=c&&(f==1||f==3&&A<=c||f==2&&A>=c)?c:ue,P=Sn(o,A<y&&i>=y?y:ei(y,A)),O=C*(_==0?t==0?.1:1:a),g=Le(cl(t+O,R/10),24),m=t<=u&&(h==1||h==3&&g>=u||h==2&&g<=u)?u:-ue,E=ei(l,g>m&&t<=m?m:Sn(m,g));return P==E&&P==0&&(E=100),[P,E]}const US=new Intl.NumberFormat(jr?RS.language:"en-US"),tu=i=>US.format(i),Yn=Math,No=Yn.PI,sn=Yn.abs,Xn=Yn.floor,en=Yn.round,Jn=Yn.ceil,ei=Yn.min,Sn=Yn.max,Hr=Yn.pow,ld=Yn.sign,Hi=Yn.log10,Bp=Yn.log2,NS=(i,t=1)=>Yn.sinh(i)*t,dc=(i,t=1)=>Yn.asinh(i/t),ue=1/0;function cd(i){return(Hi((i^i>>31)-(i>>31))|0)+1}function Mh(i,t,e){return ei(Sn(i,t),e)}function ce(i){return typeof i=="function"?i:()=>i}const kS=()=>{},zp=i=>i,Hp=(i,t)=>t,OS=i=>null,hd=i=>!0,ud=(i,t)=>i==t,FS=/\.\d*?(?=9{6,}|0{6,})/gm,zs=i=>{if(Wp(i)||ds.has(i))return i;const t=`${i}`,e=t.match(FS);if(e==null)return i;let n=e[0].length-1;if(t.indexOf("e-")!=-1){let[s,r]=t.split("e");return+`${zs(s)}e${r}`}return Le(i,n)};function Ts(i,t){return zs(Le(zs(i/t))*t)}function cl(i,t){return zs(Jn(zs(i/t))*t)}function Gp(i,t){return zs(Xn(zs(i/t))*t)}function Le(i,t=0){if(Wp(i))return i;let e=10**t,n=i*e*(1+Number.EPSILON);return en(n)/e}const ds=new Map;function Vp(i){return((""+i).split(".")[1]||"").length}function Ca(i,t,e,n){let s=[],r=n.map(Vp);for(let a=t;a<e;a++){let o=sn(a),l=Le(Hr(i,a),o);for(let c=0;c<n.length;c++){let u=i==10?+`${n[c]}e${a}`:n[c]*l,f=(a>=0?0:o)+(a>=r[c]?0:r[c]),h=i==10?u:Le(u,f);s.push(h),ds.set(h,f)}}return s}const wa={},eu=[],Gr=[null,null],ns=Array.isArray,Wp=Number.isInteger,BS=i=>i===void 0;function fd(i){return typeof i=="string"}function hl(i){let t=!1;if(i!=null){let e=i.constructor;t=e==null||e==Object}return t}function zS(i){return i!=null&&typeof i=="object"}const HS=Object.getPrototypeOf(Uint8Array),Xp="__proto__";function Vr(i,t=hl){let e;if(ns(i)){let n=i.find(s=>s!=null);if(ns(n)||t(n)){e=Array(i.length);for(let s=0;s<i.length;s++)e[s]=Vr(i[s],t)}else e=i.slice()}else if(i instanceof HS)e=i.slice();else if(t(i)){e={};for(let n in i)n!=Xp&&(e[n]=Vr(i[n],t))}else e=i;return e}function Qe(i){let t=arguments;for(let e=1;e<t.length;e++){let n=t[e];for(let s in n)s!=Xp&&(hl(i[s])?Qe(i[s],Vr(n[s])):i[s]=Vr(n[s]))}return i}const GS=0,VS=1,WS=2;function XS(i,t,e){for(let n=0,s,r=-1;n<t.length;n++){let a=t[n];if(a>r){for(s=a-1;s>=0&&i[s]==null;)i[s--]=null;for(s=a+1;s<e&&i[s]==null;)i[r=s++]=null}}}function qS(i,t){if(KS(i)){let a=i[0].slice();for(let o=1;o<i.length;o++)a.push(...i[o].slice(1));return $S(a[0])||(a=jS(a)),a}let e=new Set;for(let a=0;a<i.length;a++){let l=i[a][0],c=l.length;for(let u=0;u<c;u++)e.add(l[u])}let n=[Array.from(e).sort((a,o)=>a-o)],s=n[0].length,r=new Map;for(let a=0;a<s;a++)r.set(n[0][a],a);for(let a=0;a<i.length;a++){let o=i[a],l=o[0];for(let c=1;c<o.length;c++){let u=o[c],f=Array(s).fill(void 0),h=t?t[a][c]:VS,_=[];for(let x=0;x<u.length;x++){let M=u[x],p=r.get(l[x]);M===null?h!=GS&&(f[p]=M,h==WS&&_.push(p)):f[p]=M}XS(f,_,s),n.push(f)}}return n}const YS=typeof queueMicrotask>"u"?i=>Promise.resolve().then(i):queueMicrotask;function jS(i){let t=i[0],e=t.length,n=Array(e);for(let r=0;r<n.length;r++)n[r]=r;n.sort((r,a)=>t[r]-t[a]);let s=[];for(let r=0;r<i.length;r++){let a=i[r],o=Array(e);for(let l=0;l<e;l++)o[l]=a[n[l]];s.push(o)}return s}function KS(i){let t=i[0][0],e=t.length;for(let n=1;n<i.length;n++){let s=i[n][0];if(s.length!=e)return!1;if(s!=t){for(let r=0;r<e;r++)if(s[r]!=t[r])return!1}}return!0}function $S(i,t=100){const e=i.length;if(e<=1)return!0;let n=0,s=e-1;for(;n<=s&&i[n]==null;)n++;for(;s>=n&&i[s]==null;)s--;if(s<=n)return!0;const r=Sn(1,Xn((s-n+1)/t));for(let a=i[n],o=n+r;o<=s;o+=r){const l=i[o];if(l!=null){if(l<=a)return!1;a=l}}return!0}const qp=["January","February","March","April","May","June","July","August","September","October","November","December"],Yp=["Sunday","Monday","Tuesday","Wednesday","Thursday","Friday","Saturday"];function jp(i){return i.slice(0,3)}const ZS=Yp.map(jp),JS=qp.map(jp),QS={MMMM:qp,MMM:JS,WWWW:Yp,WWW:ZS};function _a(i){return(i<10?"0":"")+i}function t1(i){return(i<10?"00":i<100?"0":"")+i}const e1={YYYY:i=>i.getFullYear(),YY:i=>(i.getFullYear()+"").slice(2),MMMM:(i,t)=>t.MMMM[i.getMonth()],MMM:(i,t)=>t.MMM[i.getMonth()],MM:i=>_a(i.getMonth()+1),M:i=>i.getMonth()+1,DD:i=>_a(i.getDate()),D:i=>i.getDate(),WWWW:(i,t)=>t.WWWW[i.getDay()],WWW:(i,t)=>t.WWW[i.getDay()],HH:i=>_a(i.getHours()),H:i=>i.getHours(),h:i=>{let t=i.getHours();return t==0?12:t>12?t-12:t},AA:i=>i.getHours()>=12?"PM":"AM",aa:i=>i.getHours()>=12?"pm":"am",a:i=>i.getHours()>=12?"p":"a",mm:i=>_a(i.getMinutes()),m:i=>i.getMinutes(),ss:i=>_a(i.getSeconds()),s:i=>i.getSeconds(),fff:i=>t1(i.getMilliseconds())};function nu(i,t){t=t||QS;let e=[],n=/\{([a-z]+)\}|[^{]+/gi,s;for(;s=n.exec(i);)e.push(s[0][0]=="{"?e1[s[1]]:s[0]);return r=>{let a="";for(let o=0;o<e.length;o++)a+=typeof e[o]=="string"?e[o]:e[o](r,t);return a}}const n1=new Intl.DateTimeFormat().resolvedOptions().timeZone;function i1(i,t){let e;return t=="UTC"||t=="Etc/UTC"?e=new Date(+i+i.getTimezoneOffset()*6e4):t==n1?e=i:(e=new Date(i.toLocaleString("en-US",{timeZone:t})),e.setMilliseconds(i.getMilliseconds())),e}const Kp=i=>i%1==0,Zo=[1,2,2.5,5],s1=Ca(10,-32,0,Zo),$p=Ca(10,0,32,Zo),r1=$p.filter(Kp),As=s1.concat($p),iu=`
`,Zp="{YYYY}",dd=iu+Zp,Jp="{M}/{D}",ya=iu+Jp,So=ya+"/{YY}",Qp="{aa}",a1="{h}:{mm}",wr=a1+Qp,pd=iu+wr,md=":{ss}",Me=null;function tm(i){let t=i*1e3,e=t*60,n=e*60,s=n*24,r=s*30,a=s*365,l=(i==1?Ca(10,0,3,Zo).filter(Kp):Ca(10,-3,0,Zo)).concat([t,t*5,t*10,t*15,t*30,e,e*5,e*10,e*15,e*30,n,n*2,n*3,n*4,n*6,n*8,n*12,s,s*2,s*3,s*4,s*5,s*6,s*7,s*8,s*9,s*10,s*15,r,r*2,r*3,r*4,r*6,a,a*2,a*5,a*10,a*25,a*50,a*100]);const c=[[a,Zp,Me,Me,Me,Me,Me,Me,1],[s*28,"{MMM}",dd,Me,Me,Me,Me,Me,1],[s,Jp,dd,Me,Me,Me,Me,Me,1],[n,"{h}"+Qp,So,Me,ya,Me,Me,Me,1],[e,wr,So,Me,ya,Me,Me,Me,1],[t,md,So+" "+wr,Me,ya+" "+wr,Me,pd,Me,1],[i,md+".{fff}",So+" "+wr,Me,ya+" "+wr,Me,pd,Me,1]];function u(f){return(h,_,x,M,p,d)=>{let C=[],b=p>=a,R=p>=r&&p<a,D=f(x),A=Le(D*i,3),y=pc(D.getFullYear(),b?0:D.getMonth(),R||b?1:D.getDate()),P=Le(y*i,3);if(R||b){let O=R?p/r:0,g=b?p/a:0,m=A==P?A:Le(pc(y.getFullYear()+g,y.getMonth()+O,1)*i,3),E=new Date(en(m/i)),N=E.getFullYear(),F=E.getMonth();for(let B=0;m<=M;B++){let G=pc(N+g*B,F+O*B,1),$=G-f(Le(G*i,3));m=Le((+G+$)*i,3),m<=M&&C.push(m)}}else{let O=p>=s?s:p,g=Xn(x)-Xn(A),m=P+g+cl(A-P,O);C.push(m);let E=f(m),N=E.getHours()+E.getMinutes()/e+E.getSeconds()/n,F=p/n,B=h.axes[_]._space,G=d/B;for(;m=Le(m+p,i==1?0:3),!(m>M);)if(F>1){let $=Xn(Le(N+F,6))%24,ct=f(m).getHours()-$;ct>1&&(ct=-1),m-=ct*n,N=(N+F)%24;let gt=C[C.length-1];Le((m-gt)/p,3)*G>=.7&&C.push(m)}else C.push(m)}return C}}return[l,c,u]}const[o1,l1,c1]=tm(1),[h1,u1,f1]=tm(.001);Ca(2,-53,53,[1]);function gd(i,t){return i.map(e=>e.map((n,s)=>s==0||s==8||n==null?n:t(s==1||e[8]==0?n:e[1]+n)))}function _d(i,t){return(e,n,s,r,a)=>{let o=t.find(x=>a>=x[0])||t[t.length-1],l,c,u,f,h,_;return n.map(x=>{let M=i(x),p=M.getFullYear(),d=M.getMonth(),C=M.getDate(),b=M.getHours(),R=M.getMinutes(),D=M.getSeconds(),A=p!=l&&o[2]||d!=c&&o[3]||C!=u&&o[4]||b!=f&&o[5]||R!=h&&o[6]||D!=_&&o[7]||o[1];return l=p,c=d,u=C,f=b,h=R,_=D,A(M)})}}function d1(i,t){let e=nu(t);return(n,s,r,a,o)=>s.map(l=>e(i(l)))}function pc(i,t,e){return new Date(i,t,e)}function vd(i,t){return t(i)}const p1="{YYYY}-{MM}-{DD} {h}:{mm}{aa}";function xd(i,t){return(e,n,s,r)=>r==null?$h:t(i(n))}function m1(i,t){let e=i.series[t];return e.width?e.stroke(i,t):e.points.width?e.points.stroke(i,t):null}function g1(i,t){return i.series[t].fill(i,t)}const _1={show:!0,live:!0,isolate:!1,mount:kS,markers:{show:!0,width:2,stroke:m1,fill:g1,dash:"solid"},idx:null,idxs:null,values:[]};function v1(i,t){let e=i.cursor.points,n=Zn(),s=e.size(i,t);Oe(n,xa,s),Oe(n,Ma,s);let r=s/-2;Oe(n,"marginLeft",r),Oe(n,"marginTop",r);let a=e.width(i,t,s);return a&&Oe(n,"borderWidth",a),n}function x1(i,t){let e=i.series[t].points;return e._fill||e._stroke}function M1(i,t){let e=i.series[t].points;return e._stroke||e._fill}function y1(i,t){return i.series[t].points.size}const mc=[0,0];function S1(i,t,e){return mc[0]=t,mc[1]=e,mc}function Eo(i,t,e,n=!0){return s=>{s.button==0&&(!n||s.target==t)&&e(s)}}function gc(i,t,e,n=!0){return s=>{(!n||s.target==t)&&e(s)}}const E1={show:!0,x:!0,y:!0,lock:!1,move:S1,points:{one:!1,show:v1,size:y1,width:0,stroke:M1,fill:x1},bind:{mousedown:Eo,mouseup:Eo,click:Eo,dblclick:Eo,mousemove:gc,mouseleave:gc,mouseenter:gc},drag:{setScale:!0,x:!0,y:!1,dist:0,uni:null,click:(i,t)=>{t.stopPropagation(),t.stopImmediatePropagation()},_x:!1,_y:!1},focus:{dist:(i,t,e,n,s)=>n-s,prox:-1,bias:0},hover:{skip:[void 0],prox:null,bias:0},left:-10,top:-10,idx:null,dataIdx:null,idxs:null,event:null},em={show:!0,stroke:"rgba(0,0,0,0.07)",width:2},su=Qe({},em,{filter:Hp}),nm=Qe({},su,{size:10}),im=Qe({},em,{show:!1}),ru='12px system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji"',sm="bold "+ru,rm=1.5,Md={show:!0,scale:"x",stroke:Kh,space:50,gap:5,size:50,labelGap:0,labelSize:30,labelFont:sm,side:2,grid:su,ticks:nm,border:im,font:ru,lineGap:rm,rotate:0},w1="Value",b1="Time",yd={show:!0,scale:"x",auto:!1,sorted:1,min:ue,max:-ue,idxs:[]};function T1(i,t,e,n,s){return t.map(r=>r==null?"":tu(r))}function A1(i,t,e,n,s,r,a){let o=[],l=ds.get(s)||0;e=a?e:Le(cl(e,s),l);for(let c=e;c<=n;c=Le(c+s,l))o.push(Object.is(c,-0)?0:c);return o}function yh(i,t,e,n,s,r,a){const o=[],l=i.scales[i.axes[t].scale].log,c=l==10?Hi:Bp,u=Xn(c(e));s=Hr(l,u),l==10&&(s=As[ui(s,As)]);let f=e,h=s*l;l==10&&(h=As[ui(h,As)]);do o.push(f),f=f+s,l==10&&!ds.has(f)&&(f=Le(f,ds.get(s))),f>=h&&(s=f,h=s*l,l==10&&(h=As[ui(h,As)]));while(f<=n);return o}function R1(i,t,e,n,s,r,a){let l=i.scales[i.axes[t].scale].asinh,c=n>l?yh(i,t,Sn(l,e),n,s):[l],u=n>=0&&e<=0?[0]:[];return(e<-l?yh(i,t,Sn(l,-n),-e,s):[l]).reverse().map(h=>-h).concat(u,c)}const am=/./,C1=/[12357]/,P1=/[125]/,Sd=/1/,Sh=(i,t,e,n)=>i.map((s,r)=>t==4&&s==0||r%n==0&&e.test(s.toExponential()[s<0?1:0])?s:null);function L1(i,t,e,n,s){let r=i.axes[e],a=r.scale,o=i.scales[a],l=i.valToPos,c=r._space,u=l(10,a),f=l(9,a)-u>=c?am:l(7,a)-u>=c?C1:l(5,a)-u>=c?P1:Sd;if(f==Sd){let h=sn(l(1,a)-u);if(h<c)return Sh(t.slice().reverse(),o.distr,f,Jn(c/h)).reverse()}return Sh(t,o.distr,f,1)}function D1(i,t,e,n,s){let r=i.axes[e],a=r.scale,o=r._space,l=i.valToPos,c=sn(l(1,a)-l(2,a));return c<o?Sh(t.slice().reverse(),3,am,Jn(o/c)).reverse():t}function I1(i,t,e,n){return n==null?$h:t==null?"":tu(t)}const Ed={show:!0,scale:"y",stroke:Kh,space:30,gap:5,size:50,labelGap:0,labelSize:30,labelFont:sm,side:3,grid:su,ticks:nm,border:im,font:ru,lineGap:rm,rotate:0};function U1(i,t){let e=3+(i||1)*2;return Le(e*t,3)}function N1(i,t){let{scale:e,idxs:n}=i.series[0],s=i._data[0],r=i.valToPos(s[n[0]],e,!0),a=i.valToPos(s[n[1]],e,!0),o=sn(a-r),l=i.series[t],c=o/(l.points.space*xe);return n[1]-n[0]<=c}const wd={scale:null,auto:!0,sorted:0,min:ue,max:-ue},om=(i,t,e,n,s)=>s,bd={show:!0,auto:!0,sorted:0,gaps:om,alpha:1,facets:[Qe({},wd,{scale:"x"}),Qe({},wd,{scale:"y"})]},Td={scale:"y",auto:!0,sorted:0,show:!0,spanGaps:!1,gaps:om,alpha:1,points:{show:N1,filter:null},values:null,min:ue,max:-ue,idxs:[],path:null,clip:null};function k1(i,t,e,n,s){return e/10}const lm={time:oS,auto:!0,distr:1,log:10,asinh:1,min:null,max:null,dir:1,ori:0},O1=Qe({},lm,{time:!1,ori:1}),Ad={};function cm(i,t){let e=Ad[i];return e||(e={key:i,plots:[],sub(n){e.plots.push(n)},unsub(n){e.plots=e.plots.filter(s=>s!=n)},pub(n,s,r,a,o,l,c){for(let u=0;u<e.plots.length;u++)e.plots[u]!=s&&e.plots[u].pub(n,s,r,a,o,l,c)}},i!=null&&(Ad[i]=e)),e}const Wr=1,Eh=2;function Vs(i,t,e){const n=i.mode,s=i.series[t],r=n==2?i._data[t]:i._data,a=i.scales,o=i.bbox;let l=r[0],c=n==2?r[1]:r[t],u=n==2?a[s.facets[0].scale]:a[i.series[0].scale],f=n==2?a[s.facets[1].scale]:a[s.scale],h=o.left,_=o.top,x=o.width,M=o.height,p=i.valToPosH,d=i.valToPosV;return u.ori==0?e(s,l,c,u,f,p,d,h,_,x,M,fl,Kr,pl,um,dm):e(s,l,c,u,f,d,p,_,h,M,x,dl,$r,lu,fm,pm)}function au(i,t){let e=0,n=0,s=ve(i.bands,eu);for(let r=0;r<s.length;r++){let a=s[r];a.series[0]==t?e=a.dir:a.series[1]==t&&(a.dir==1?n|=1:n|=2)}return[e,n==1?-1:n==2?1:n==3?2:0]}function F1(i,t,e,n,s){let r=i.mode,a=i.series[t],o=r==2?a.facets[1].scale:a.scale,l=i.scales[o];return s==-1?l.min:s==1?l.max:l.distr==3?l.dir==1?l.min:l.max:0}function Gi(i,t,e,n,s,r){return Vs(i,t,(a,o,l,c,u,f,h,_,x,M,p)=>{let d=a.pxRound;const C=c.dir*(c.ori==0?1:-1),b=c.ori==0?Kr:$r;let R,D;C==1?(R=e,D=n):(R=n,D=e);let A=d(f(o[R],c,M,_)),y=d(h(l[R],u,p,x)),P=d(f(o[D],c,M,_)),O=d(h(r==1?u.max:u.min,u,p,x)),g=new Path2D(s);return b(g,P,O),b(g,A,O),b(g,A,y),g})}function ul(i,t,e,n,s,r){let a=null;if(i.length>0){a=new Path2D;const o=t==0?pl:lu;let l=e;for(let f=0;f<i.length;f++){let h=i[f];if(h[1]>h[0]){let _=h[0]-l;_>0&&o(a,l,n,_,n+r),l=h[1]}}let c=e+s-l,u=10;c>0&&o(a,l,n-u/2,c,n+r+u)}return a}function B1(i,t,e){let n=i[i.length-1];n&&n[0]==t?n[1]=e:i.push([t,e])}function ou(i,t,e,n,s,r,a){let o=[],l=i.length;for(let c=s==1?e:n;c>=e&&c<=n;c+=s)if(t[c]===null){let f=c,h=c;if(s==1)for(;++c<=n&&t[c]===null;)h=c;else for(;--c>=e&&t[c]===null;)h=c;let _=r(i[f]),x=h==f?_:r(i[h]),M=f-s;_=a<=0&&M>=0&&M<l?r(i[M]):_;let d=h+s;x=a>=0&&d>=0&&d<l?r(i[d]):x,x>=_&&o.push([_,x])}return o}function Rd(i){return i==0?zp:i==1?en:t=>Ts(t,i)}function hm(i){let t=i==0?fl:dl,e=i==0?(s,r,a,o,l,c)=>{s.arcTo(r,a,o,l,c)}:(s,r,a,o,l,c)=>{s.arcTo(a,r,l,o,c)},n=i==0?(s,r,a,o,l)=>{s.rect(r,a,o,l)}:(s,r,a,o,l)=>{s.rect(a,r,l,o)};return(s,r,a,o,l,c=0,u=0)=>{c==0&&u==0?n(s,r,a,o,l):(c=ei(c,o/2,l/2),u=ei(u,o/2,l/2),t(s,r+c,a),e(s,r+o,a,r+o,a+l,c),e(s,r+o,a+l,r,a+l,u),e(s,r,a+l,r,a,u),e(s,r,a,r+o,a,c),s.closePath())}}const fl=(i,t,e)=>{i.moveTo(t,e)},dl=(i,t,e)=>{i.moveTo(e,t)},Kr=(i,t,e)=>{i.lineTo(t,e)},$r=(i,t,e)=>{i.lineTo(e,t)},pl=hm(0),lu=hm(1),um=(i,t,e,n,s,r)=>{i.arc(t,e,n,s,r)},fm=(i,t,e,n,s,r)=>{i.arc(e,t,n,s,r)},dm=(i,t,e,n,s,r,a)=>{i.bezierCurveTo(t,e,n,s,r,a)},pm=(i,t,e,n,s,r,a)=>{i.bezierCurveTo(e,t,s,n,a,r)};function mm(i){return(t,e,n,s,r)=>Vs(t,e,(a,o,l,c,u,f,h,_,x,M,p)=>{let{pxRound:d,points:C}=a,b,R;c.ori==0?(b=fl,R=um):(b=dl,R=fm);const D=Le(C.width*xe,3);let A=(C.size-C.width)/2*xe,y=Le(A*2,3),P=new Path2D,O=new Path2D,{left:g,top:m,width:E,height:N}=t.bbox;pl(O,g-y,m-y,E+y*2,N+y*2);const F=B=>{if(l[B]!=null){let G=d(f(o[B],c,M,_)),$=d(h(l[B],u,p,x));b(P,G+A,$),R(P,G,$,A,0,No*2)}};if(r)r.forEach(F);else for(let B=n;B<=s;B++)F(B);return{stroke:D>0?P:null,fill:P,clip:O,flags:Wr|Eh}})}function gm(i){return(t,e,n,s,r,a)=>{n!=s&&(r!=n&&a!=n&&i(t,e,n),r!=s&&a!=s&&i(t,e,s),i(t,e,a))}}const z1=gm(Kr),H1=gm($r);function _m(i){const t=ve(i?.alignGaps,0);return(e,n,s,r)=>Vs(e,n,(a,o,l,c,u,f,h,_,x,M,p)=>{let d=a.pxRound,C=xt=>d(f(xt,c,M,_)),b=xt=>d(h(xt,u,p,x)),R,D;c.ori==0?(R=Kr,D=z1):(R=$r,D=H1);const A=c.dir*(c.ori==0?1:-1),y={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:Wr},P=y.stroke;let O=ue,g=-ue,m,E,N,F=C(o[A==1?s:r]),B=zr(l,s,r,1*A),G=zr(l,s,r,-1*A),$=C(o[B]),Q=C(o[G]),dt=!1;for(let xt=A==1?s:r;xt>=s&&xt<=r;xt+=A){let Vt=C(o[xt]),rt=l[xt];Vt==F?rt!=null?(E=b(rt),O==ue&&(R(P,Vt,E),m=E),O=ei(E,O),g=Sn(E,g)):rt===null&&(dt=!0):(O!=ue&&(D(P,F,O,g,m,E),N=F),rt!=null?(E=b(rt),R(P,Vt,E),O=g=m=E):(O=ue,g=-ue,rt===null&&(dt=!0)),F=Vt)}O!=ue&&O!=g&&N!=F&&D(P,F,O,g,m,E);let[ct,gt]=au(e,n);if(a.fill!=null||ct!=0){let xt=y.fill=new Path2D(P),Vt=a.fillTo(e,n,a.min,a.max,ct),rt=b(Vt);R(xt,Q,rt),R(xt,$,rt)}if(!a.spanGaps){let xt=[];dt&&xt.push(...ou(o,l,s,r,A,C,t)),y.gaps=xt=a.gaps(e,n,s,r,xt),y.clip=ul(xt,c.ori,_,x,M,p)}return gt!=0&&(y.band=gt==2?[Gi(e,n,s,r,P,-1),Gi(e,n,s,r,P,1)]:Gi(e,n,s,r,P,gt)),y})}function G1(i){const t=ve(i.align,1),e=ve(i.ascDesc,!1),n=ve(i.alignGaps,0),s=ve(i.extend,!1);return(r,a,o,l)=>Vs(r,a,(c,u,f,h,_,x,M,p,d,C,b)=>{let R=c.pxRound,{left:D,width:A}=r.bbox,y=ct=>R(x(ct,h,C,p)),P=ct=>R(M(ct,_,b,d)),O=h.ori==0?Kr:$r;const g={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:Wr},m=g.stroke,E=h.dir*(h.ori==0?1:-1);o=zr(f,o,l,1),l=zr(f,o,l,-1);let N=P(f[E==1?o:l]),F=y(u[E==1?o:l]),B=F,G=F;s&&t==-1&&(G=D,O(m,G,N)),O(m,F,N);for(let ct=E==1?o:l;ct>=o&&ct<=l;ct+=E){let gt=f[ct];if(gt==null)continue;let xt=y(u[ct]),Vt=P(gt);t==1?O(m,xt,N):O(m,B,Vt),O(m,xt,Vt),N=Vt,B=xt}let $=B;s&&t==1&&($=D+A,O(m,$,N));let[Q,dt]=au(r,a);if(c.fill!=null||Q!=0){let ct=g.fill=new Path2D(m),gt=c.fillTo(r,a,c.min,c.max,Q),xt=P(gt);O(ct,$,xt),O(ct,G,xt)}if(!c.spanGaps){let ct=[];ct.push(...ou(u,f,o,l,E,y,n));let gt=c.width*xe/2,xt=e||t==1?gt:-gt,Vt=e||t==-1?-gt:gt;ct.forEach(rt=>{rt[0]+=xt,rt[1]+=Vt}),g.gaps=ct=c.gaps(r,a,o,l,ct),g.clip=ul(ct,h.ori,p,d,C,b)}return dt!=0&&(g.band=dt==2?[Gi(r,a,o,l,m,-1),Gi(r,a,o,l,m,1)]:Gi(r,a,o,l,m,dt)),g})}function Cd(i,t,e,n,s,r,a=ue){if(i.length>1){let o=null;for(let l=0,c=1/0;l<i.length;l++)if(t[l]!==void 0){if(o!=null){let u=sn(i[l]-i[o]);u<c&&(c=u,a=sn(e(i[l],n,s,r)-e(i[o],n,s,r)))}o=l}}return a}function V1(i){i=i||wa;const t=ve(i.size,[.6,ue,1]),e=i.align||0,n=i.gap||0;let s=i.radius;s=s==null?[0,0]:typeof s=="number"?[s,0]:s;const r=ce(s),a=1-t[0],o=ve(t[1],ue),l=ve(t[2],1),c=ve(i.disp,wa),u=ve(i.each,_=>{}),{fill:f,stroke:h}=c;return(_,x,M,p)=>Vs(_,x,(d,C,b,R,D,A,y,P,O,g,m)=>{let E=d.pxRound,N=e,F=n*xe,B=o*xe,G=l*xe,$,Q;R.ori==0?[$,Q]=r(_,x):[Q,$]=r(_,x);const dt=R.dir*(R.ori==0?1:-1);let ct=R.ori==0?pl:lu,gt=R.ori==0?u:(nt,It,wt,Ut,re,mt,Rt)=>{u(nt,It,wt,re,Ut,Rt,mt)},xt=ve(_.bands,eu).find(nt=>nt.series[0]==x),Vt=xt!=null?xt.dir:0,rt=d.fillTo(_,x,d.min,d.max,Vt),pt=E(y(rt,D,m,O)),Dt,St,Z,J=g,Y=E(d.width*xe),at=!1,ot=null,I=null,Ot=null,Mt=null;f!=null&&(Y==0||h!=null)&&(at=!0,ot=f.values(_,x,M,p),I=new Map,new Set(ot).forEach(nt=>{nt!=null&&I.set(nt,new Path2D)}),Y>0&&(Ot=h.values(_,x,M,p),Mt=new Map,new Set(Ot).forEach(nt=>{nt!=null&&Mt.set(nt,new Path2D)})));let{x0:Ht,size:At}=c;if(Ht!=null&&At!=null){N=1,C=Ht.values(_,x,M,p),Ht.unit==2&&(C=C.map(wt=>_.posToVal(P+wt*g,R.key,!0)));let nt=At.values(_,x,M,p);At.unit==2?St=nt[0]*g:St=A(nt[0],R,g,P)-A(0,R,g,P),J=Cd(C,b,A,R,g,P,J),Z=J-St+F}else J=Cd(C,b,A,R,g,P,J),Z=J*a+F,St=J-Z;Z<1&&(Z=0),Y>=St/2&&(Y=0),Z<5&&(E=zp);let Et=Z>0,Xt=J-Z-(Et?Y:0);St=E(Mh(Xt,G,B)),Dt=(N==0?St/2:N==dt?0:St)-N*dt*((N==0?F/2:0)+(Et?Y/2:0));const L={stroke:null,fill:null,clip:null,band:null,gaps:null,flags:0},w=at?null:new Path2D;let V=null;if(xt!=null)V=_.data[xt.series[1]];else{let{y0:nt,y1:It}=c;nt!=null&&It!=null&&(b=It.values(_,x,M,p),V=nt.values(_,x,M,p))}let it=$*St,ht=Q*St;for(let nt=dt==1?M:p;nt>=M&&nt<=p;nt+=dt){let It=b[nt];if(It==null)continue;if(V!=null){let Lt=V[nt]??0;if(It-Lt==0)continue;pt=y(Lt,D,m,O)}let wt=R.distr!=2||c!=null?C[nt]:nt,Ut=A(wt,R,g,P),re=y(ve(It,rt),D,m,O),mt=E(Ut-Dt),Rt=E(Sn(re,pt)),jt=E(ei(re,pt)),$t=Rt-jt;if(It!=null){let Lt=It<0?ht:it,ie=It<0?it:ht;at?(Y>0&&Ot[nt]!=null&&ct(Mt.get(Ot[nt]),mt,jt+Xn(Y/2),St,Sn(0,$t-Y),Lt,ie),ot[nt]!=null&&ct(I.get(ot[nt]),mt,jt+Xn(Y/2),St,Sn(0,$t-Y),Lt,ie)):ct(w,mt,jt+Xn(Y/2),St,Sn(0,$t-Y),Lt,ie),gt(_,x,nt,mt-Y/2,jt,St+Y,$t)}}return Y>0?L.stroke=at?Mt:w:at||(L._fill=d.width==0?d._fill:d._stroke??d._fill,L.width=0),L.fill=at?I:w,L})}function W1(i,t){const e=ve(t?.alignGaps,0);return(n,s,r,a)=>Vs(n,s,(o,l,c,u,f,h,_,x,M,p,d)=>{let C=o.pxRound,b=$=>C(h($,u,p,x)),R=$=>C(_($,f,d,M)),D,A,y;u.ori==0?(D=fl,y=Kr,A=dm):(D=dl,y=$r,A=pm);const P=u.dir*(u.ori==0?1:-1);r=zr(c,r,a,1),a=zr(c,r,a,-1);let O=b(l[P==1?r:a]),g=O,m=[],E=[];for(let $=P==1?r:a;$>=r&&$<=a;$+=P)if(c[$]!=null){let dt=l[$],ct=b(dt);m.push(g=ct),E.push(R(c[$]))}const N={stroke:i(m,E,D,y,A,C),fill:null,clip:null,band:null,gaps:null,flags:Wr},F=N.stroke;let[B,G]=au(n,s);if(o.fill!=null||B!=0){let $=N.fill=new Path2D(F),Q=o.fillTo(n,s,o.min,o.max,B),dt=R(Q);y($,g,dt),y($,O,dt)}if(!o.spanGaps){let $=[];$.push(...ou(l,c,r,a,P,b,e)),N.gaps=$=o.gaps(n,s,r,a,$),N.clip=ul($,u.ori,x,M,p,d)}return G!=0&&(N.band=G==2?[Gi(n,s,r,a,F,-1),Gi(n,s,r,a,F,1)]:Gi(n,s,r,a,F,G)),N})}function X1(i){return W1(q1,i)}function q1(i,t,e,n,s,r){const a=i.length;if(a<2)return null;const o=new Path2D;if(e(o,i[0],t[0]),a==2)n(o,i[1],t[1]);else{let l=Array(a),c=Array(a-1),u=Array(a-1),f=Array(a-1);for(let h=0;h<a-1;h++)u[h]=t[h+1]-t[h],f[h]=i[h+1]-i[h],c[h]=u[h]/f[h];l[0]=c[0];for(let h=1;h<a-1;h++)c[h]===0||c[h-1]===0||c[h-1]>0!=c[h]>0?l[h]=0:(l[h]=3*(f[h-1]+f[h])/((2*f[h]+f[h-1])/c[h-1]+(f[h]+2*f[h-1])/c[h]),isFinite(l[h])||(l[h]=0));l[a-1]=c[a-2];for(let h=0;h<a-1;h++)s(o,i[h]+f[h]/3,t[h]+l[h]*f[h]/3,i[h+1]-f[h]/3,t[h+1]-l[h+1]*f[h]/3,i[h+1],t[h+1])}return o}const wh=new Set;function Pd(){for(let i of wh)i.syncRect(!0)}jr&&(Ns(TS,Ir,Pd),Ns(AS,Ir,Pd,!0),Ns(Ko,Ir,()=>{En.pxRatio=xe}));const Y1=_m(),j1=mm();function Ld(i,t,e,n){return(n?[i[0],i[1]].concat(i.slice(2)):[i[0]].concat(i.slice(1))).map((r,a)=>bh(r,a,t,e))}function K1(i,t){return i.map((e,n)=>n==0?{}:Qe({},t,e))}function bh(i,t,e,n){return Qe({},t==0?e:n,i)}function vm(i,t,e){return t==null?Gr:[t,e]}const $1=vm;function Z1(i,t,e){return t==null?Gr:$o(t,e,Qh,!0)}function xm(i,t,e,n){return t==null?Gr:ll(t,e,i.scales[n].log,!1)}const J1=xm;function Mm(i,t,e,n){return t==null?Gr:Jh(t,e,i.scales[n].log,!1)}const Q1=Mm;function tE(i,t,e,n,s){let r=Sn(cd(i),cd(t)),a=t-i,o=ui(s/n*a,e);do{let l=e[o],c=n*l/a;if(c>=s&&r+(l<5?ds.get(l):0)<=17)return[l,c]}while(++o<e.length);return[0,0]}function Dd(i){let t,e;return i=i.replace(/(\d+)px/,(n,s)=>(t=en((e=+s)*xe))+"px"),[i,t,e]}function eE(i){i.show&&[i.font,i.labelFont].forEach(t=>{let e=Le(t[2]*xe,1);t[0]=t[0].replace(/[0-9.]+px/,e+"px"),t[1]=e})}function En(i,t,e){const n={mode:ve(i.mode,1)},s=n.mode;function r(v,S){return((S.distr==3?Hi(v>0?v:S.clamp(n,v,S.min,S.max,S.key)):S.distr==4?dc(v,S.asinh):S.distr==100?S.fwd(v):v)-S._min)/(S._max-S._min)}function a(v,S,U,k){let X=r(v,S);return k+U*(S.dir==-1?1-X:X)}function o(v,S,U,k){let X=r(v,S);return k+U*(S.dir==-1?X:1-X)}function l(v,S,U,k){return S.ori==0?a(v,S,U,k):o(v,S,U,k)}n.valToPosH=a,n.valToPosV=o;let c=!1;n.status=0;const u=n.root=Zn(lS);if(i.id!=null&&(u.id=i.id),Hn(u,i.class),i.title){let v=Zn(uS,u);v.textContent=i.title}const f=hi("canvas"),h=n.ctx=f.getContext("2d"),_=Zn(fS,u);Ns("click",_,v=>{v.target===M&&(Ue!=Zs||ze!=Js)&&mn.click(n,v)},!0);const x=n.under=Zn(dS,_);_.appendChild(f);const M=n.over=Zn(pS,_);i=Vr(i);const p=+ve(i.pxAlign,1),d=Rd(p);(i.plugins||[]).forEach(v=>{v.opts&&(i=v.opts(n,i)||i)});const C=i.ms||.001,b=n.series=s==1?Ld(i.series||[],yd,Td,!1):K1(i.series||[null],bd),R=n.axes=Ld(i.axes||[],Md,Ed,!0),D=n.scales={},A=n.bands=i.bands||[];A.forEach(v=>{v.fill=ce(v.fill||null),v.dir=ve(v.dir,-1)});const y=s==2?b[1].facets[0].scale:b[0].scale,P={axes:Um,series:gi},O=(i.drawOrder||["axes","series"]).map(v=>P[v]);function g(v){let S=D[v];if(S==null){let U=(i.scales||wa)[v]||wa;if(U.from!=null)g(U.from),D[v]=Qe({},D[U.from],U,{key:v});else{S=D[v]=Qe({},v==y?lm:O1,U),S.key=v;let k=S.time,X=S.range,st=ns(X);if((v!=y||s==2&&!k)&&(st&&(X[0]==null||X[1]==null)&&(X={min:X[0]==null?ad:{mode:1,hard:X[0],soft:X[0]},max:X[1]==null?ad:{mode:1,hard:X[1],soft:X[1]}},st=!1),!st&&hl(X))){let ut=X;X=(_t,yt,kt)=>yt==null?Gr:$o(yt,kt,ut)}S.range=ce(X||(k?$1:v==y?S.distr==3?J1:S.distr==4?Q1:vm:S.distr==3?xm:S.distr==4?Mm:Z1)),S.auto=ce(st?!1:S.auto),S.clamp=ce(S.clamp||k1),S._min=S._max=null}}}g("x"),g("y"),s==1&&b.forEach(v=>{g(v.scale)}),R.forEach(v=>{g(v.scale)});for(let v in i.scales)g(v);const m=D[y],E=m.distr;let N,F;m.ori==0?(Hn(u,cS),N=a,F=o):(Hn(u,hS),N=o,F=a);const B={};for(let v in D){let S=D[v];(S.min!=null||S.max!=null)&&(B[v]={min:S.min,max:S.max},S.min=S.max=null)}const G=i.tzDate||(v=>new Date(en(v/C))),$=i.fmtDate||nu,Q=C==1?c1(G):f1(G),dt=_d(G,gd(C==1?l1:u1,$)),ct=xd(G,vd(p1,$)),gt=[],xt=n.legend=Qe({},_1,i.legend),Vt=xt.show,rt=xt.markers;xt.idxs=gt,rt.width=ce(rt.width),rt.dash=ce(rt.dash),rt.stroke=ce(rt.stroke),rt.fill=ce(rt.fill);let pt,Dt,St,Z=[],J=[],Y,at=!1,ot={};if(xt.live){const v=b[1]?b[1].values:null;at=v!=null,Y=at?v(n,1,0):{_:0};for(let S in Y)ot[S]=$h}if(Vt)if(pt=hi("table",MS,u),St=hi("tbody",null,pt),xt.mount(n,pt),at){Dt=hi("thead",null,pt,St);let v=hi("tr",null,Dt);hi("th",null,v);for(var I in Y)hi("th",qf,v).textContent=I}else Hn(pt,SS),xt.live&&Hn(pt,yS);const Ot={show:!0},Mt={show:!1};function Ht(v,S){if(S==0&&(at||!xt.live||s==2))return Gr;let U=[],k=hi("tr",ES,St,St.childNodes[S]);Hn(k,v.class),v.show||Hn(k,Ps);let X=hi("th",null,k);if(rt.show){let _t=Zn(wS,X);if(S>0){let yt=rt.width(n,S);yt&&(_t.style.border=yt+"px "+rt.dash(n,S)+" "+rt.stroke(n,S)),_t.style.background=rt.fill(n,S)}}let st=Zn(qf,X);st.textContent=v.label,S>0&&(rt.show||(st.style.color=v.width>0?rt.stroke(n,S):rt.fill(n,S)),Et("click",X,_t=>{if(bt._lock)return;Xe(_t);let yt=b.indexOf(v);if((_t.ctrlKey||_t.metaKey)!=xt.isolate){let kt=b.some((Ft,zt)=>zt>0&&zt!=yt&&Ft.show);b.forEach((Ft,zt)=>{zt>0&&_i(zt,kt?zt==yt?Ot:Mt:Ot,!0,$e.setSeries)})}else _i(yt,{show:!v.show},!0,$e.setSeries)},!1),Ri&&Et(Zf,X,_t=>{bt._lock||(Xe(_t),_i(b.indexOf(v),tr,!0,$e.setSeries))},!1));for(var ut in Y){let _t=hi("td",bS,k);_t.textContent="--",U.push(_t)}return[k,U]}const At=new Map;function Et(v,S,U,k=!0){const X=At.get(S)||{},st=bt.bind[v](n,S,U,k);st&&(Ns(v,S,X[v]=st),At.set(S,X))}function Xt(v,S,U){const k=At.get(S)||{};for(let X in k)(v==null||X==v)&&(xh(X,S,k[X]),delete k[X]);v==null&&At.delete(S)}let L=0,w=0,V=0,it=0,ht=0,nt=0,It=ht,wt=nt,Ut=V,re=it,mt=0,Rt=0,jt=0,$t=0;n.bbox={};let Lt=!1,ie=!1,te=!1,pe=!1,q=!1,Tt=!1;function lt(v,S,U){(U||v!=n.width||S!=n.height)&&ft(v,S),Ys(!1),te=!0,ie=!0,js()}function ft(v,S){n.width=L=V=v,n.height=w=it=S,ht=nt=0,We(),_n();let U=n.bbox;mt=U.left=Ts(ht*xe,.5),Rt=U.top=Ts(nt*xe,.5),jt=U.width=Ts(V*xe,.5),$t=U.height=Ts(it*xe,.5)}const Nt=3;function Bt(){let v=!1,S=0;for(;!v;){S++;let U=Dm(S),k=Im(S);v=S==Nt||U&&k,v||(ft(n.width,n.height),ie=!0)}}function fe({width:v,height:S}){lt(v,S)}n.setSize=fe;function We(){let v=!1,S=!1,U=!1,k=!1;R.forEach((X,st)=>{if(X.show&&X._show){let{side:ut,_size:_t}=X,yt=ut%2,kt=X.label!=null?X.labelSize:0,Ft=_t+kt;Ft>0&&(yt?(V-=Ft,ut==3?(ht+=Ft,k=!0):U=!0):(it-=Ft,ut==0?(nt+=Ft,v=!0):S=!0))}}),pi[0]=v,pi[1]=U,pi[2]=S,pi[3]=k,V-=T[1]+T[3],ht+=T[3],it-=T[2]+T[0],nt+=T[0]}function _n(){let v=ht+V,S=nt+it,U=ht,k=nt;function X(st,ut){switch(st){case 1:return v+=ut,v-ut;case 2:return S+=ut,S-ut;case 3:return U-=ut,U+ut;case 0:return k-=ut,k+ut}}R.forEach((st,ut)=>{if(st.show&&st._show){let _t=st.side;st._pos=X(_t,st._size),st.label!=null&&(st._lpos=X(_t,st.labelSize))}})}const bt=n.cursor=Qe({},E1,{drag:{y:s==2}},i.cursor);if(bt.dataIdx==null){let v=bt.hover,S=v.skip=new Set(v.skip??[]);S.add(void 0);let U=v.prox=ce(v.prox),k=v.bias??=0;bt.dataIdx=(X,st,ut,_t)=>{if(st==0)return ut;let yt=ut,kt=U(X,st,ut,_t)??ue,Ft=kt>=0&&kt<ue,zt=m.ori==0?V:it,ee=bt.left,Ce=t[0],de=t[st];if(S.has(de[ut])){yt=null;let le=null,se=null,Yt;if(k==0||k==-1)for(Yt=ut;le==null&&Yt-- >0;)S.has(de[Yt])||(le=Yt);if(k==0||k==1)for(Yt=ut;se==null&&Yt++<de.length;)S.has(de[Yt])||(se=Yt);if(le!=null||se!=null)if(Ft){let Ee=le==null?-1/0:N(Ce[le],m,zt,0),Ke=se==null?1/0:N(Ce[se],m,zt,0),qe=ee-Ee,ke=Ke-ee;qe<=ke?qe<=kt&&(yt=le):ke<=kt&&(yt=se)}else yt=se==null?le:le==null?se:ut-le<=se-ut?le:se}else Ft&&sn(ee-N(Ce[ut],m,zt,0))>kt&&(yt=null);return yt}}const Xe=v=>{bt.event=v};bt.idxs=gt,bt._lock=!1;let De=bt.points;De.show=ce(De.show),De.size=ce(De.size),De.stroke=ce(De.stroke),De.width=ce(De.width),De.fill=ce(De.fill);const si=n.focus=Qe({},i.focus||{alpha:.3},bt.focus),Ri=si.prox>=0,Dn=Ri&&De.one;let vn=[],Ci=[],Pi=[];function ms(v,S){let U=De.show(n,S);if(U)return Hn(U,xS),Hn(U,v.class),Mi(U,-10,-10,V,it),M.insertBefore(U,vn[S]),U}function Zr(v,S){if(s==1||S>0){let U=s==1&&D[v.scale].time,k=v.value;v.value=U?fd(k)?xd(G,vd(k,$)):k||ct:k||I1,v.label=v.label||(U?b1:w1)}if(Dn||S>0){v.width=v.width==null?1:v.width,v.paths=v.paths||Y1||OS,v.fillTo=ce(v.fillTo||F1),v.pxAlign=+ve(v.pxAlign,p),v.pxRound=Rd(v.pxAlign),v.stroke=ce(v.stroke||null),v.fill=ce(v.fill||null),v._stroke=v._fill=v._paths=v._focus=null;let U=U1(Sn(1,v.width),1),k=v.points=Qe({},{size:U,width:Sn(1,U*.2),stroke:v.stroke,space:U*2,paths:j1,_stroke:null,_fill:null},v.points);k.show=ce(k.show),k.filter=ce(k.filter),k.fill=ce(k.fill),k.stroke=ce(k.stroke),k.paths=ce(k.paths),k.pxAlign=v.pxAlign}if(Vt){let U=Ht(v,S);Z.splice(S,0,U[0]),J.splice(S,0,U[1]),xt.values.push(null)}if(bt.show){gt.splice(S,0,null);let U=null;Dn?S==0&&(U=ms(v,S)):S>0&&(U=ms(v,S)),vn.splice(S,0,U),Ci.splice(S,0,0),Pi.splice(S,0,0)}fn("addSeries",S)}function Ws(v,S){S=S??b.length,v=s==1?bh(v,S,yd,Td):bh(v,S,{},bd),b.splice(S,0,v),Zr(b[S],S)}n.addSeries=Ws;function Ia(v){if(b.splice(v,1),Vt){xt.values.splice(v,1),J.splice(v,1);let S=Z.splice(v,1)[0];Xt(null,S.firstChild),S.remove()}bt.show&&(gt.splice(v,1),vn.splice(v,1)[0].remove(),Ci.splice(v,1),Pi.splice(v,1)),fn("delSeries",v)}n.delSeries=Ia;const pi=[!1,!1,!1,!1];function ml(v,S){if(v._show=v.show,v.show){let U=v.side%2,k=D[v.scale];k==null&&(v.scale=U?b[1].scale:y,k=D[v.scale]);let X=k.time;v.size=ce(v.size),v.space=ce(v.space),v.rotate=ce(v.rotate),ns(v.incrs)&&v.incrs.forEach(ut=>{!ds.has(ut)&&ds.set(ut,Vp(ut))}),v.incrs=ce(v.incrs||(k.distr==2?r1:X?C==1?o1:h1:As)),v.splits=ce(v.splits||(X&&k.distr==1?Q:k.distr==3?yh:k.distr==4?R1:A1)),v.stroke=ce(v.stroke),v.grid.stroke=ce(v.grid.stroke),v.ticks.stroke=ce(v.ticks.stroke),v.border.stroke=ce(v.border.stroke);let st=v.values;v.values=ns(st)&&!ns(st[0])?ce(st):X?ns(st)?_d(G,gd(st,$)):fd(st)?d1(G,st):st||dt:st||T1,v.filter=ce(v.filter||(k.distr>=3&&k.log==10?L1:k.distr==3&&k.log==2?D1:Hp)),v.font=Dd(v.font),v.labelFont=Dd(v.labelFont),v._size=v.size(n,null,S,0),v._space=v._rotate=v._incrs=v._found=v._splits=v._values=null,v._size>0&&(pi[S]=!0,v._el=Zn(mS,_))}}function gs(v,S,U,k){let[X,st,ut,_t]=U,yt=S%2,kt=0;return yt==0&&(_t||st)&&(kt=S==0&&!X||S==2&&!ut?en(Md.size/3):0),yt==1&&(X||ut)&&(kt=S==1&&!st||S==3&&!_t?en(Ed.size/2):0),kt}const Ua=n.padding=(i.padding||[gs,gs,gs,gs]).map(v=>ce(ve(v,gs))),T=n._padding=Ua.map((v,S)=>v(n,S,pi,0));let W,tt=null,et=null;const K=s==1?b[0].idxs:null;let vt=null,Ct=!1;function Gt(v,S){if(t=v??[],n.data=n._data=t,s==2){W=0;for(let U=1;U<b.length;U++)W+=t[U][0].length}else{t.length==0&&(n.data=n._data=t=[[]]),vt=t[0],W=vt.length;let U=t;if(E==2){U=t.slice();let k=U[0]=Array(W);for(let X=0;X<W;X++)k[X]=X}n._data=t=U}if(Ys(!0),fn("setData"),E==2&&(te=!0),S!==!1){let U=m;U.auto(n,Ct)?Wt():Xi(y,U.min,U.max),pe=pe||bt.left>=0,Tt=!0,js()}}n.setData=Gt;function Wt(){Ct=!0;let v,S;s==1&&(W>0?(tt=K[0]=0,et=K[1]=W-1,v=t[0][tt],S=t[0][et],E==2?(v=tt,S=et):v==S&&(E==3?[v,S]=ll(v,v,m.log,!1):E==4?[v,S]=Jh(v,v,m.log,!1):m.time?S=v+en(86400/C):[v,S]=$o(v,S,Qh,!0))):(tt=K[0]=v=null,et=K[1]=S=null)),Xi(y,v,S)}let Jt,Zt,qt,ge,Se,Ie,pn,me,Kt,Re;function _e(v,S,U,k,X,st){v??=jf,U??=eu,k??="butt",X??=jf,st??="round",v!=Jt&&(h.strokeStyle=Jt=v),X!=Zt&&(h.fillStyle=Zt=X),S!=qt&&(h.lineWidth=qt=S),st!=Se&&(h.lineJoin=Se=st),k!=Ie&&(h.lineCap=Ie=k),U!=ge&&h.setLineDash(ge=U)}function In(v,S,U,k){S!=Zt&&(h.fillStyle=Zt=S),v!=pn&&(h.font=pn=v),U!=me&&(h.textAlign=me=U),k!=Kt&&(h.textBaseline=Kt=k)}function mi(v,S,U,k,X=0){if(k.length>0&&v.auto(n,Ct)&&(S==null||S.min==null)){let st=ve(tt,0),ut=ve(et,k.length-1),_t=U.min==null?v.distr==3?LS(k,st,ut):PS(k,st,ut,X):[U.min,U.max];v.min=ei(v.min,U.min=_t[0]),v.max=Sn(v.max,U.max=_t[1])}}const xn={min:null,max:null};function Jr(){for(let k in D){let X=D[k];B[k]==null&&(X.min==null||B[y]!=null&&X.auto(n,Ct))&&(B[k]=xn)}for(let k in D){let X=D[k];B[k]==null&&X.from!=null&&B[X.from]!=null&&(B[k]=xn)}B[y]!=null&&Ys(!0);let v={};for(let k in B){let X=B[k];if(X!=null){let st=v[k]=Vr(D[k],zS);if(X.min!=null)Qe(st,X);else if(k!=y||s==2)if(W==0&&st.from==null){let ut=st.range(n,null,null,k);st.min=ut[0],st.max=ut[1]}else st.min=ue,st.max=-ue}}if(W>0){b.forEach((k,X)=>{if(s==1){let st=k.scale,ut=B[st];if(ut==null)return;let _t=v[st];if(X==0){let yt=_t.range(n,_t.min,_t.max,st);_t.min=yt[0],_t.max=yt[1],tt=ui(_t.min,t[0]),et=ui(_t.max,t[0]),et-tt>1&&(t[0][tt]<_t.min&&tt++,t[0][et]>_t.max&&et--),k.min=vt[tt],k.max=vt[et]}else k.show&&k.auto&&mi(_t,ut,k,t[X],k.sorted);k.idxs[0]=tt,k.idxs[1]=et}else if(X>0&&k.show&&k.auto){let[st,ut]=k.facets,_t=st.scale,yt=ut.scale,[kt,Ft]=t[X],zt=v[_t],ee=v[yt];zt!=null&&mi(zt,B[_t],st,kt,st.sorted),ee!=null&&mi(ee,B[yt],ut,Ft,ut.sorted),k.min=ut.min,k.max=ut.max}});for(let k in v){let X=v[k],st=B[k];if(X.from==null&&(st==null||st.min==null)){let ut=X.range(n,X.min==ue?null:X.min,X.max==-ue?null:X.max,k);X.min=ut[0],X.max=ut[1]}}}for(let k in v){let X=v[k];if(X.from!=null){let st=v[X.from];if(st.min==null)X.min=X.max=null;else{let ut=X.range(n,st.min,st.max,k);X.min=ut[0],X.max=ut[1]}}}let S={},U=!1;for(let k in v){let X=v[k],st=D[k];if(st.min!=X.min||st.max!=X.max){st.min=X.min,st.max=X.max;let ut=st.distr;st._min=ut==3?Hi(st.min):ut==4?dc(st.min,st.asinh):ut==100?st.fwd(st.min):st.min,st._max=ut==3?Hi(st.max):ut==4?dc(st.max,st.asinh):ut==100?st.fwd(st.max):st.max,S[k]=U=!0}}if(U){b.forEach((k,X)=>{s==2?X>0&&S.y&&(k._paths=null):S[k.scale]&&(k._paths=null)});for(let k in S)te=!0,fn("setScale",k);bt.show&&bt.left>=0&&(pe=Tt=!0)}for(let k in B)B[k]=null}function Ve(v){let S=Mh(tt-1,0,W-1),U=Mh(et+1,0,W-1);for(;v[S]==null&&S>0;)S--;for(;v[U]==null&&U<W-1;)U++;return[S,U]}function gi(){W>0&&(b.forEach((v,S)=>{if(S>0&&v.show&&(Xs(S,!1),Xs(S,!0),v._paths==null)){Re!=v.alpha&&(h.globalAlpha=Re=v.alpha);let U=s==2?[0,t[S][0].length-1]:Ve(t[S]);v._paths=v.paths(n,S,U[0],U[1]),Re!=1&&(h.globalAlpha=Re=1)}}),b.forEach((v,S)=>{if(S>0&&v.show){Re!=v.alpha&&(h.globalAlpha=Re=v.alpha),v._paths!=null&&wn(S,!1);{let U=v._paths!=null?v._paths.gaps:null,k=v.points.show(n,S,tt,et,U),X=v.points.filter(n,S,k,U);(k||X)&&(v.points._paths=v.points.paths(n,S,tt,et,X),wn(S,!0))}Re!=1&&(h.globalAlpha=Re=1),fn("drawSeries",S)}}))}function Xs(v,S){let U=S?b[v].points:b[v];U._stroke=U.stroke(n,v),U._fill=U.fill(n,v)}function wn(v,S){let U=S?b[v].points:b[v],{stroke:k,fill:X,clip:st,flags:ut,_stroke:_t=U._stroke,_fill:yt=U._fill,_width:kt=U.width}=U._paths;kt=Le(kt*xe,3);let Ft=null,zt=kt%2/2;S&&yt==null&&(yt=kt>0?"#fff":_t);let ee=U.pxAlign==1&&zt>0;if(ee&&h.translate(zt,zt),!S){let Ce=mt-kt/2,de=Rt-kt/2,le=jt+kt,se=$t+kt;Ft=new Path2D,Ft.rect(Ce,de,le,se)}S?qs(_t,kt,U.dash,U.cap,yt,k,X,ut,st):Qr(v,_t,kt,U.dash,U.cap,yt,k,X,ut,Ft,st),ee&&h.translate(-zt,-zt)}function Qr(v,S,U,k,X,st,ut,_t,yt,kt,Ft){let zt=!1;yt!=0&&A.forEach((ee,Ce)=>{if(ee.series[0]==v){let de=b[ee.series[1]],le=t[ee.series[1]],se=(de._paths||wa).band;ns(se)&&(se=ee.dir==1?se[0]:se[1]);let Yt,Ee=null;de.show&&se&&IS(le,tt,et)?(Ee=ee.fill(n,Ce)||st,Yt=de._paths.clip):se=null,qs(S,U,k,X,Ee,ut,_t,yt,kt,Ft,Yt,se),zt=!0}}),zt||qs(S,U,k,X,st,ut,_t,yt,kt,Ft)}const Na=Wr|Eh;function qs(v,S,U,k,X,st,ut,_t,yt,kt,Ft,zt){_e(v,S,U,k,X),(yt||kt||zt)&&(h.save(),yt&&h.clip(yt),kt&&h.clip(kt)),zt?(_t&Na)==Na?(h.clip(zt),Ft&&h.clip(Ft),Oa(X,ut),ka(v,st,S)):_t&Eh?(Oa(X,ut),h.clip(zt),ka(v,st,S)):_t&Wr&&(h.save(),h.clip(zt),Ft&&h.clip(Ft),Oa(X,ut),h.restore(),ka(v,st,S)):(Oa(X,ut),ka(v,st,S)),(yt||kt||zt)&&h.restore()}function ka(v,S,U){U>0&&(S instanceof Map?S.forEach((k,X)=>{h.strokeStyle=Jt=X,h.stroke(k)}):S!=null&&v&&h.stroke(S))}function Oa(v,S){S instanceof Map?S.forEach((U,k)=>{h.fillStyle=Zt=k,h.fill(U)}):S!=null&&v&&h.fill(S)}function Lm(v,S,U,k){let X=R[v],st;if(k<=0)st=[0,0];else{let ut=X._space=X.space(n,v,S,U,k),_t=X._incrs=X.incrs(n,v,S,U,k,ut);st=tE(S,U,_t,k,ut)}return X._found=st}function gl(v,S,U,k,X,st,ut,_t,yt,kt){let Ft=ut%2/2;p==1&&h.translate(Ft,Ft),_e(_t,ut,yt,kt,_t),h.beginPath();let zt,ee,Ce,de,le=X+(k==0||k==3?-st:st);U==0?(ee=X,de=le):(zt=X,Ce=le);for(let se=0;se<v.length;se++)S[se]!=null&&(U==0?zt=Ce=v[se]:ee=de=v[se],h.moveTo(zt,ee),h.lineTo(Ce,de));h.stroke(),p==1&&h.translate(-Ft,-Ft)}function Dm(v){let S=!0;return R.forEach((U,k)=>{if(!U.show)return;let X=D[U.scale];if(X.min==null){U._show&&(S=!1,U._show=!1,Ys(!1));return}else U._show||(S=!1,U._show=!0,Ys(!1));let st=U.side,ut=st%2,{min:_t,max:yt}=X,[kt,Ft]=Lm(k,_t,yt,ut==0?V:it);if(Ft==0)return;let zt=X.distr==2,ee=U._splits=U.splits(n,k,_t,yt,kt,Ft,zt),Ce=X.distr==2?ee.map(Yt=>vt[Yt]):ee,de=X.distr==2?vt[ee[1]]-vt[ee[0]]:kt,le=U._values=U.values(n,U.filter(n,Ce,k,Ft,de),k,Ft,de);U._rotate=st==2?U.rotate(n,le,k,Ft):0;let se=U._size;U._size=Jn(U.size(n,le,k,v)),se!=null&&U._size!=se&&(S=!1)}),S}function Im(v){let S=!0;return Ua.forEach((U,k)=>{let X=U(n,k,pi,v);X!=T[k]&&(S=!1),T[k]=X}),S}function Um(){for(let v=0;v<R.length;v++){let S=R[v];if(!S.show||!S._show)continue;let U=S.side,k=U%2,X,st,ut=S.stroke(n,v),_t=U==0||U==3?-1:1;if(S.label){let An=S.labelGap*_t,Fn=en((S._lpos+An)*xe);In(S.labelFont[0],ut,"center",U==2?ga:Yf),h.save(),k==1?(X=st=0,h.translate(Fn,en(Rt+$t/2)),h.rotate((U==3?-No:No)/2)):(X=en(mt+jt/2),st=Fn),h.fillText(S.label,X,st),h.restore()}let[yt,kt]=S._found;if(kt==0)continue;let Ft=D[S.scale],zt=k==0?jt:$t,ee=k==0?mt:Rt,Ce=en(S.gap*xe),de=S._splits,le=Ft.distr==2?de.map(An=>vt[An]):de,se=Ft.distr==2?vt[de[1]]-vt[de[0]]:yt,Yt=S.ticks,Ee=S.border,Ke=Yt.show?en(Yt.size*xe):0,qe=S._rotate*-No/180,ke=d(S._pos*xe),Ze=(Ke+Ce)*_t,Un=ke+Ze;st=k==0?Un:0,X=k==1?Un:0;let Nn=S.font[0],jn=S.align==1?yr:S.align==2?uc:qe>0?yr:qe<0?uc:k==0?"center":U==3?uc:yr,ri=qe||k==1?"middle":U==2?ga:Yf;In(Nn,ut,jn,ri);let ai=S.font[1]*S.lineGap,bn=de.map(An=>d(l(An,Ft,zt,ee))),xi=S._values;for(let An=0;An<xi.length;An++){let Fn=xi[An];if(Fn!=null){k==0?X=bn[An]:st=bn[An],Fn=""+Fn;let nr=Fn.indexOf(`
`)==-1?[Fn]:Fn.split(/\n/gm);for(let ji=0;ji<nr.length;ji++){let Kn=nr[ji];qe?(h.save(),h.translate(X,st+ji*ai),h.rotate(qe),h.fillText(Kn,0,0),h.restore()):h.fillText(Kn,X,st+ji*ai)}}}Yt.show&&gl(bn,Yt.filter(n,le,v,kt,se),k,U,ke,Ke,Le(Yt.width*xe,3),Yt.stroke(n,v),Yt.dash,Yt.cap);let Tn=S.grid;Tn.show&&gl(bn,Tn.filter(n,le,v,kt,se),k,k==0?2:1,k==0?Rt:mt,k==0?$t:jt,Le(Tn.width*xe,3),Tn.stroke(n,v),Tn.dash,Tn.cap),Ee.show&&gl([ke],[1],k==0?1:0,k==0?1:2,k==1?Rt:mt,k==1?$t:jt,Le(Ee.width*xe,3),Ee.stroke(n,v),Ee.dash,Ee.cap)}fn("drawAxes")}function Ys(v){b.forEach((S,U)=>{U>0&&(S._paths=null,v&&(s==1?(S.min=null,S.max=null):S.facets.forEach(k=>{k.min=null,k.max=null})))})}let Fa=!1,_l=!1,ta=[];function Nm(){_l=!1;for(let v=0;v<ta.length;v++)fn(...ta[v]);ta.length=0}function js(){Fa||(YS(hu),Fa=!0)}function km(v,S=!1){Fa=!0,_l=S,v(n),hu(),S&&ta.length>0&&queueMicrotask(Nm)}n.batch=km;function hu(){if(Lt&&(Jr(),Lt=!1),te&&(Bt(),te=!1),ie){if(Oe(x,yr,ht),Oe(x,ga,nt),Oe(x,xa,V),Oe(x,Ma,it),Oe(M,yr,ht),Oe(M,ga,nt),Oe(M,xa,V),Oe(M,Ma,it),Oe(_,xa,L),Oe(_,Ma,w),f.width=en(L*xe),f.height=en(w*xe),R.forEach(({_el:v,_show:S,_size:U,_pos:k,side:X})=>{if(v!=null)if(S){let st=X===3||X===0?U:0,ut=X%2==1;Oe(v,ut?"left":"top",k-st),Oe(v,ut?"width":"height",U),Oe(v,ut?"top":"left",ut?nt:ht),Oe(v,ut?"height":"width",ut?it:V),vh(v,Ps)}else Hn(v,Ps)}),Jt=Zt=qt=Se=Ie=pn=me=Kt=ge=null,Re=1,ia(!0),ht!=It||nt!=wt||V!=Ut||it!=re){Ys(!1);let v=V/Ut,S=it/re;if(bt.show&&!pe&&bt.left>=0){bt.left*=v,bt.top*=S,Ks&&Mi(Ks,en(bt.left),0,V,it),$s&&Mi($s,0,en(bt.top),V,it);for(let U=0;U<vn.length;U++){let k=vn[U];k!=null&&(Ci[U]*=v,Pi[U]*=S,Mi(k,Jn(Ci[U]),Jn(Pi[U]),V,it))}}if(Ne.show&&!q&&Ne.left>=0&&Ne.width>0){Ne.left*=v,Ne.width*=v,Ne.top*=S,Ne.height*=S;for(let U in El)Oe(Qs,U,Ne[U])}It=ht,wt=nt,Ut=V,re=it}fn("setSize"),ie=!1}L>0&&w>0&&(h.clearRect(0,0,f.width,f.height),fn("drawClear"),O.forEach(v=>v()),fn("draw")),Ne.show&&q&&(Ba(Ne),q=!1),bt.show&&pe&&(vs(null,!0,!1),pe=!1),xt.show&&xt.live&&Tt&&(yl(),Tt=!1),c||(c=!0,n.status=1,fn("ready")),Ct=!1,Fa=!1}n.redraw=(v,S)=>{te=S||!1,v!==!1?Xi(y,m.min,m.max):js()};function vl(v,S){let U=D[v];if(U.from==null){if(W==0){let k=U.range(n,S.min,S.max,v);S.min=k[0],S.max=k[1]}if(S.min>S.max){let k=S.min;S.min=S.max,S.max=k}if(W>1&&S.min!=null&&S.max!=null&&S.max-S.min<1e-16)return;v==y&&U.distr==2&&W>0&&(S.min=ui(S.min,t[0]),S.max=ui(S.max,t[0]),S.min==S.max&&S.max++),B[v]=S,Lt=!0,js()}}n.setScale=vl;let xl,Ml,Ks,$s,uu,fu,Zs,Js,du,pu,Ue,ze,Wi=!1;const mn=bt.drag;let hn=mn.x,un=mn.y;bt.show&&(bt.x&&(xl=Zn(_S,M)),bt.y&&(Ml=Zn(vS,M)),m.ori==0?(Ks=xl,$s=Ml):(Ks=Ml,$s=xl),Ue=bt.left,ze=bt.top);const Ne=n.select=Qe({show:!0,over:!0,left:0,width:0,top:0,height:0},i.select),Qs=Ne.show?Zn(gS,Ne.over?M:x):null;function Ba(v,S){if(Ne.show){for(let U in v)Ne[U]=v[U],U in El&&Oe(Qs,U,v[U]);S!==!1&&fn("setSelect")}}n.setSelect=Ba;function Om(v,S){let U=b[v],k=Vt?Z[v]:null;if(U.show)k&&vh(k,Ps);else{k&&Hn(k,Ps);let X=Dn?vn[0]:vn[v];Mi(X,-10,-10,V,it)}}function Xi(v,S,U){vl(v,{min:S,max:U})}function _i(v,S,U,k){S.focus!=null&&Gm(v),S.show!=null&&b.forEach((X,st)=>{st>0&&(v==st||v==null)&&(X.show=S.show,Om(st,S.show),s==2?(Xi(X.facets[0].scale,null,null),Xi(X.facets[1].scale,null,null)):Xi(X.scale,null,null),js())}),U!==!1&&fn("setSeries",v,S),k&&sa("setSeries",n,v,S)}n.setSeries=_i;function Fm(v,S){Qe(A[v],S)}function Bm(v,S){v.fill=ce(v.fill||null),v.dir=ve(v.dir,-1),S=S??A.length,A.splice(S,0,v)}function zm(v){v==null?A.length=0:A.splice(v,1)}n.addBand=Bm,n.setBand=Fm,n.delBand=zm;function Hm(v,S){b[v].alpha=S,bt.show&&vn[v]&&(vn[v].style.opacity=S),Vt&&Z[v]&&(Z[v].style.opacity=S)}let Li,qi,_s;const tr={focus:!0};function Gm(v){if(v!=_s){let S=v==null,U=si.alpha!=1;b.forEach((k,X)=>{if(s==1||X>0){let st=S||X==0||X==v;k._focus=S?null:st,U&&Hm(X,st?1:si.alpha)}}),_s=v,U&&js()}}Vt&&Ri&&Et(Jf,pt,v=>{bt._lock||(Xe(v),_s!=null&&_i(null,tr,!0,$e.setSeries))});function vi(v,S,U){let k=D[S];U&&(v=v/xe-(k.ori==1?nt:ht));let X=V;k.ori==1&&(X=it,v=X-v),k.dir==-1&&(v=X-v);let st=k._min,ut=k._max,_t=v/X,yt=st+(ut-st)*_t,kt=k.distr;return kt==3?Hr(10,yt):kt==4?NS(yt,k.asinh):kt==100?k.bwd(yt):yt}function Vm(v,S){let U=vi(v,y,S);return ui(U,t[0],tt,et)}n.valToIdx=v=>ui(v,t[0]),n.posToIdx=Vm,n.posToVal=vi,n.valToPos=(v,S,U)=>D[S].ori==0?a(v,D[S],U?jt:V,U?mt:0):o(v,D[S],U?$t:it,U?Rt:0),n.setCursor=(v,S,U)=>{Ue=v.left,ze=v.top,vs(null,S,U)};function mu(v,S){Oe(Qs,yr,Ne.left=v),Oe(Qs,xa,Ne.width=S)}function gu(v,S){Oe(Qs,ga,Ne.top=v),Oe(Qs,Ma,Ne.height=S)}let ea=m.ori==0?mu:gu,na=m.ori==1?mu:gu;function Wm(){if(Vt&&xt.live)for(let v=s==2?1:0;v<b.length;v++){if(v==0&&at)continue;let S=xt.values[v],U=0;for(let k in S)J[v][U++].firstChild.nodeValue=S[k]}}function yl(v,S){if(v!=null&&(v.idxs?v.idxs.forEach((U,k)=>{gt[k]=U}):BS(v.idx)||gt.fill(v.idx),xt.idx=gt[0]),Vt&&xt.live){for(let U=0;U<b.length;U++)(U>0||s==1&&!at)&&Xm(U,gt[U]);Wm()}Tt=!1,S!==!1&&fn("setLegend")}n.setLegend=yl;function Xm(v,S){let U=b[v],k=v==0&&E==2?vt:t[v],X;at?X=U.values(n,v,S)??ot:(X=U.value(n,S==null?null:k[S],v,S),X=X==null?ot:{_:X}),xt.values[v]=X}function vs(v,S,U){du=Ue,pu=ze,[Ue,ze]=bt.move(n,Ue,ze),bt.left=Ue,bt.top=ze,bt.show&&(Ks&&Mi(Ks,en(Ue),0,V,it),$s&&Mi($s,0,en(ze),V,it));let k,X=tt>et;Li=ue,qi=null;let st=m.ori==0?V:it,ut=m.ori==1?V:it;if(Ue<0||W==0||X){k=bt.idx=null;for(let _t=0;_t<b.length;_t++){let yt=vn[_t];yt!=null&&Mi(yt,-10,-10,V,it)}Ri&&_i(null,tr,!0,v==null&&$e.setSeries),xt.live&&(gt.fill(k),Tt=!0)}else{let _t,yt,kt;s==1&&(_t=m.ori==0?Ue:ze,yt=vi(_t,y),k=bt.idx=ui(yt,t[0],tt,et),kt=N(t[0][k],m,st,0));let Ft=-10,zt=-10,ee=0,Ce=0,de=!0,le="",se="";for(let Yt=s==2?1:0;Yt<b.length;Yt++){let Ee=b[Yt],Ke=gt[Yt],qe=Ke==null?null:s==1?t[Yt][Ke]:t[Yt][1][Ke],ke=bt.dataIdx(n,Yt,k,yt),Ze=ke==null?null:s==1?t[Yt][ke]:t[Yt][1][ke];Tt=Tt||Ze!=qe||ke!=Ke,gt[Yt]=ke;let Un=ke==k?kt:N(s==1?t[0][ke]:t[Yt][0][ke],m,st,0);if(Yt>0&&Ee.show){let Nn=Ze==null?-10:F(Ze,s==1?D[Ee.scale]:D[Ee.facets[1].scale],ut,0);if(Ri&&Ze!=null){let jn=m.ori==1?Ue:ze,ri=sn(si.dist(n,Yt,ke,Nn,jn));if(ri<Li){let ai=si.bias;if(ai!=0){let bn=vi(jn,Ee.scale),xi=Ze>=0?1:-1,Tn=bn>=0?1:-1;Tn==xi&&(Tn==1?ai==1?Ze>=bn:Ze<=bn:ai==1?Ze<=bn:Ze>=bn)&&(Li=ri,qi=Yt)}else Li=ri,qi=Yt}}if(Tt||Dn){let jn,ri;m.ori==0?(jn=Un,ri=Nn):(jn=Nn,ri=Un);let ai,bn,xi,Tn,An,Fn,nr=!0,ji=De.bbox;if(ji!=null){nr=!1;let Kn=ji(n,Yt);xi=Kn.left,Tn=Kn.top,ai=Kn.width,bn=Kn.height}else xi=jn,Tn=ri,ai=bn=De.size(n,Yt);if(Fn=De.fill(n,Yt),An=De.stroke(n,Yt),Dn)Yt==qi&&Li<=si.prox&&(Ft=xi,zt=Tn,ee=ai,Ce=bn,de=nr,le=Fn,se=An);else{let Kn=vn[Yt];Kn!=null&&(Ci[Yt]=xi,Pi[Yt]=Tn,rd(Kn,ai,bn,nr),id(Kn,Fn,An),Mi(Kn,Jn(xi),Jn(Tn),V,it))}}}}if(Dn){let Yt=si.prox,Ee=_s==null?Li<=Yt:Li>Yt||qi!=_s;if(Tt||Ee){let Ke=vn[0];Ci[0]=Ft,Pi[0]=zt,rd(Ke,ee,Ce,de),id(Ke,le,se),Mi(Ke,Jn(Ft),Jn(zt),V,it)}}}if(Ne.show&&Wi)if(v!=null){let[_t,yt]=$e.scales,[kt,Ft]=$e.match,[zt,ee]=v.cursor.sync.scales,Ce=v.cursor.drag;if(hn=Ce._x,un=Ce._y,hn||un){let{left:de,top:le,width:se,height:Yt}=v.select,Ee=v.scales[zt].ori,Ke=v.posToVal,qe,ke,Ze,Un,Nn,jn=_t!=null&&kt(_t,zt),ri=yt!=null&&Ft(yt,ee);jn&&hn?(Ee==0?(qe=de,ke=se):(qe=le,ke=Yt),Ze=D[_t],Un=N(Ke(qe,zt),Ze,st,0),Nn=N(Ke(qe+ke,zt),Ze,st,0),ea(ei(Un,Nn),sn(Nn-Un))):ea(0,st),ri&&un?(Ee==1?(qe=de,ke=se):(qe=le,ke=Yt),Ze=D[yt],Un=F(Ke(qe,ee),Ze,ut,0),Nn=F(Ke(qe+ke,ee),Ze,ut,0),na(ei(Un,Nn),sn(Nn-Un))):na(0,ut)}else za()}else{let _t=sn(du-uu),yt=sn(pu-fu);if(m.ori==1){let ee=_t;_t=yt,yt=ee}hn=mn.x&&_t>=mn.dist,un=mn.y&&yt>=mn.dist;let kt=mn.uni;kt!=null?hn&&un&&(hn=_t>=kt,un=yt>=kt,!hn&&!un&&(yt>_t?un=!0:hn=!0)):mn.x&&mn.y&&(hn||un)&&(hn=un=!0);let Ft,zt;hn&&(m.ori==0?(Ft=Zs,zt=Ue):(Ft=Js,zt=ze),ea(ei(Ft,zt),sn(zt-Ft)),un||na(0,ut)),un&&(m.ori==1?(Ft=Zs,zt=Ue):(Ft=Js,zt=ze),na(ei(Ft,zt),sn(zt-Ft)),hn||ea(0,st)),!hn&&!un&&(ea(0,0),na(0,0))}if(mn._x=hn,mn._y=un,v==null){if(U){if(Au!=null){let[_t,yt]=$e.scales;$e.values[0]=_t!=null?vi(m.ori==0?Ue:ze,_t):null,$e.values[1]=yt!=null?vi(m.ori==1?Ue:ze,yt):null}sa(Kf,n,Ue,ze,V,it,k)}if(Ri){let _t=U&&$e.setSeries,yt=si.prox;_s==null?Li<=yt&&_i(qi,tr,!0,_t):Li>yt?_i(null,tr,!0,_t):qi!=_s&&_i(qi,tr,!0,_t)}}Tt&&(xt.idx=k,yl()),S!==!1&&fn("setCursor")}let Yi=null;Object.defineProperty(n,"rect",{get(){return Yi==null&&ia(!1),Yi}});function ia(v=!1){v?Yi=null:(Yi=M.getBoundingClientRect(),fn("syncRect",Yi))}function _u(v,S,U,k,X,st,ut){bt._lock||Wi&&v!=null&&v.movementX==0&&v.movementY==0||(Sl(v,S,U,k,X,st,ut,!1,v!=null),v!=null?vs(null,!0,!0):vs(S,!0,!1))}function Sl(v,S,U,k,X,st,ut,_t,yt){if(Yi==null&&ia(!1),Xe(v),v!=null)U=v.clientX-Yi.left,k=v.clientY-Yi.top;else{if(U<0||k<0){Ue=-10,ze=-10;return}let[kt,Ft]=$e.scales,zt=S.cursor.sync,[ee,Ce]=zt.values,[de,le]=zt.scales,[se,Yt]=$e.match,Ee=S.axes[0].side%2==1,Ke=m.ori==0?V:it,qe=m.ori==1?V:it,ke=Ee?st:X,Ze=Ee?X:st,Un=Ee?k:U,Nn=Ee?U:k;if(de!=null?U=se(kt,de)?l(ee,D[kt],Ke,0):-10:U=Ke*(Un/ke),le!=null?k=Yt(Ft,le)?l(Ce,D[Ft],qe,0):-10:k=qe*(Nn/Ze),m.ori==1){let jn=U;U=k,k=jn}}yt&&((U<=1||U>=V-1)&&(U=Ts(U,V)),(k<=1||k>=it-1)&&(k=Ts(k,it))),_t?(uu=U,fu=k,[Zs,Js]=bt.move(n,U,k)):(Ue=U,ze=k)}const El={width:0,height:0,left:0,top:0};function za(){Ba(El,!1)}let vu,xu,Mu,yu;function Su(v,S,U,k,X,st,ut){Wi=!0,hn=un=mn._x=mn._y=!1,Sl(v,S,U,k,X,st,ut,!0,!1),v!=null&&(Et(fc,gh,Eu,!1),sa($f,n,Zs,Js,V,it,null));let{left:_t,top:yt,width:kt,height:Ft}=Ne;vu=_t,xu=yt,Mu=kt,yu=Ft,za()}function Eu(v,S,U,k,X,st,ut){Wi=mn._x=mn._y=!1,Sl(v,S,U,k,X,st,ut,!1,!0);let{left:_t,top:yt,width:kt,height:Ft}=Ne,zt=kt>0||Ft>0,ee=vu!=_t||xu!=yt||Mu!=kt||yu!=Ft;if(zt&&ee&&Ba(Ne),mn.setScale&&zt&&ee){let Ce=_t,de=kt,le=yt,se=Ft;if(m.ori==1&&(Ce=yt,de=Ft,le=_t,se=kt),hn&&Xi(y,vi(Ce,y),vi(Ce+de,y)),un)for(let Yt in D){let Ee=D[Yt];Yt!=y&&Ee.from==null&&Ee.min!=ue&&Xi(Yt,vi(le+se,Yt),vi(le,Yt))}za()}else bt.lock&&(bt._lock=!bt._lock,vs(null,!0,!1));v!=null&&(Xt(fc,gh),sa(fc,n,Ue,ze,V,it,null))}function qm(v,S,U,k,X,st,ut){if(bt._lock)return;Xe(v);let _t=Wi;if(Wi){let yt=!0,kt=!0,Ft=10,zt,ee;m.ori==0?(zt=hn,ee=un):(zt=un,ee=hn),zt&&ee&&(yt=Ue<=Ft||Ue>=V-Ft,kt=ze<=Ft||ze>=it-Ft),zt&&yt&&(Ue=Ue<Zs?0:V),ee&&kt&&(ze=ze<Js?0:it),vs(null,!0,!0),Wi=!1}Ue=-10,ze=-10,vs(null,!0,!0),_t&&(Wi=_t)}function wu(v,S,U,k,X,st,ut){bt._lock||(Xe(v),Wt(),za(),v!=null&&sa(Qf,n,Ue,ze,V,it,null))}function bu(){R.forEach(eE),lt(n.width,n.height,!0)}Ns(Ko,Ir,bu);const er={};er.mousedown=Su,er.mousemove=_u,er.mouseup=Eu,er.dblclick=wu,er.setSeries=(v,S,U,k)=>{let X=$e.match[2];U=X(n,S,U),U!=-1&&_i(U,k,!0,!1)},bt.show&&(Et($f,M,Su),Et(Kf,M,_u),Et(Zf,M,v=>{Xe(v),ia(!1)}),Et(Jf,M,qm),Et(Qf,M,wu),wh.add(n),n.syncRect=ia);const Ha=n.hooks=i.hooks||{};function fn(v,S,U){_l?ta.push([v,S,U]):v in Ha&&Ha[v].forEach(k=>{k.call(null,n,S,U)})}(i.plugins||[]).forEach(v=>{for(let S in v.hooks)Ha[S]=(Ha[S]||[]).concat(v.hooks[S])});const Tu=(v,S,U)=>U,$e=Qe({key:null,setSeries:!1,filters:{pub:hd,sub:hd},scales:[y,b[1]?b[1].scale:null],match:[ud,ud,Tu],values:[null,null]},bt.sync);$e.match.length==2&&$e.match.push(Tu),bt.sync=$e;const Au=$e.key,wl=cm(Au);function sa(v,S,U,k,X,st,ut){$e.filters.pub(v,S,U,k,X,st,ut)&&wl.pub(v,S,U,k,X,st,ut)}wl.sub(n);function Ym(v,S,U,k,X,st,ut){$e.filters.sub(v,S,U,k,X,st,ut)&&er[v](null,S,U,k,X,st,ut)}n.pub=Ym;function jm(){wl.unsub(n),wh.delete(n),At.clear(),xh(Ko,Ir,bu),u.remove(),pt?.remove(),fn("destroy")}n.destroy=jm;function bl(){fn("init",i,t),Gt(t||i.data,!1),B[y]?vl(y,B[y]):Wt(),q=Ne.show&&(Ne.width>0||Ne.height>0),pe=Tt=!0,lt(i.width,i.height)}return b.forEach(Zr),R.forEach(ml),e?e instanceof HTMLElement?(e.appendChild(u),bl()):e(n,bl):bl(),n}En.assign=Qe;En.fmtNum=tu;En.rangeNum=$o;En.rangeLog=ll;En.rangeAsinh=Jh;En.orient=Vs;En.pxRatio=xe;En.join=qS;En.fmtDate=nu,En.tzDate=i1;En.sync=cm;{En.addGap=B1,En.clipGaps=ul;let i=En.paths={points:mm};i.linear=_m,i.stepped=G1,i.bars=V1,i.spline=X1}const Id=56;class nE{constructor(){this.node=z("div",{class:"spark",role:"img"}),this.plot=null,this.colours="",this.width=0}draw(t,e,n,s){this.node.setAttribute("aria-label",s);const r=Math.floor(this.node.clientWidth);if(r<20)return;const a=getComputedStyle(document.documentElement),o=a.getPropertyValue("--accent").trim(),l=a.getPropertyValue("--red").trim();this.plot===null||this.colours!==o?this.build(r,o,l):this.width!==r&&this.plot.setSize({width:r,height:Id}),this.width=r,this.plot?.setData([t,e,t.map(()=>n)])}build(t,e,n){this.plot?.destroy(),this.colours=e,this.plot=new En({width:t,height:Id,padding:[4,0,4,0],legend:{show:!1},cursor:{show:!1},select:{show:!1,left:0,top:0,width:0,height:0},axes:[{show:!1},{show:!1}],scales:{x:{time:!1,range:[-mh,0]},y:{range:(s,r,a)=>[Math.min(0,r??0),Math.max(a??0,.001)*1.1]}},series:[{},{stroke:e,width:1.5,points:{show:!1}},{stroke:n,width:1,dash:[4,4],points:{show:!1}}]},[[],[],[]],this.node)}}const wo=["gate","force","rtt","loss","gap","age","margin","trips","late","temperature","link"];function iE(i,t){const e=qh(i),n=t?.force_limit_n??null;return{gate:{text:hs("gate",i.gate),band:kp(i.gate)},force:{text:H("cards.of_limit",{f:nn(e,2,"N"),limit:nn(n,1,"N")}),band:Up(Yh(i,t))},rtt:{text:nn(i.rtt_ms,1,"ms"),band:Is(i.rtt_ms,Lp)},loss:{text:nn(i.loss_percent,1,"%"),band:Is(i.loss_percent,Dp)},gap:{text:nn(i.gap_ms,1,"ms"),band:Is(i.gap_ms,Xh)},age:{text:nn(i.age_ms,1,"ms"),band:Is(i.age_ms,nS)},margin:{text:nn(i.margin_j===null?null:i.margin_j*1e3,1,"mJ"),band:Np(i.margin_j)},trips:{text:nn(i.trips,0),band:i.trips===null?"unknown":i.trips>0?"amber":"green"},late:{text:nn(i.late,0),band:i.late===null?"unknown":i.late>0?"amber":"green"},temperature:{text:nn(i.temperature_c,0,"°C"),band:Op(i.temperature_c)},link:{text:H(`band.${ph(i)}`),band:ph(i)}}}class sE{constructor(t){this.page=t,this.grid=z("div",{class:"cards"}),this.quantity="force",this.cards=[],this.known=null,this.sparkAt=0;const e=ii(Fp.map(n=>[n,H(`quantity.${n}`)]),"force",n=>{this.quantity=n,this.sparkAt=0});this.node=qn(H("cards.title"),"cards-panel",Ye(H("cards.quantity"),e),this.grid)}update(){const{scene:t,state:e}=this.page.model;if(!t)return;t!==this.known&&this.adopt(t);const n=performance.now(),s=n-this.sparkAt>500;s&&(this.sparkAt=n),this.cards.forEach((r,a)=>{const o=e?.seats[a];if(!o)return;const l=iE(o,t.seats[a]),c=wo.map(f=>l[f].band),u=o.taken!==!1;as(r.node,"data-band",u?o.heard===!1?"red":Ip(c):"unknown"),r.node.classList.toggle("free",!u),Ae(r.person,u?o.person??"":H("who.free")),r.meter.value=Math.min(1,Yh(o,t.seats[a])??0);for(const f of wo)Ae(r.cells[f],l[f].text),as(r.cells[f],"data-band",l[f].band),as(r.cells[f],"title",H(`level.${l[f].band}`));s&&this.drawSpark(r,a,t.seats[a])})}drawSpark(t,e,n){const[s,r]=this.page.model.history.series(e,this.quantity),a={force:n?.force_limit_n??null,rtt:null,loss:null,margin:null}[this.quantity],o=H("cards.spark",{quantity:H(`quantity.${this.quantity}`),seat:n?.name??"",value:nn(r[r.length-1],2)});t.spark.draw(s,r,a,o)}adopt(t){this.known=t,this.cards=t.seats.map((e,n)=>{const s=Object.fromEntries(wo.map(u=>[u,z("dd")])),r=z("span",{class:"person"}),a=z("meter",{min:0,max:1,low:.8,high:.999,optimum:0,"aria-label":`${e.name}: ${H("cards.force")}`}),o=new nE,l=wo.map(u=>z("div",{},z("dt",{},H(`cards.${u}`)),s[u]));return{node:z("article",{class:"card","aria-label":e.name},z("h3",{},ol(n),e.name,r),a,o.node,z("dl",{},...l)),person:r,meter:a,cells:s,spark:o}}),this.sparkAt=0,this.grid.replaceChildren(...this.cards.map(e=>e.node))}}function rE(i){return!i||i.taken===null?Ti:i.taken?i.heard===!1?H("who.lost"):i.engaged===null?Ti:H(i.engaged?"who.engaged":"who.released"):H("who.free")}class aE{constructor(t){this.page=t,this.rows=z("tbody"),this.cells=[],this.known=null,this.drain=He(H("stop.drain"),()=>void this.askDrain());const e=["seat","person","role","device","state"].map(n=>z("th",{scope:"col"},H(`who.${n}`)));this.node=qn(H("who.title"),"who-panel",z("div",{class:"scroll",tabindex:0,role:"region","aria-label":H("who.title")},z("table",{},z("thead",{},z("tr",{},...e,z("td"))),this.rows)),z("div",{class:"row"},this.drain))}update(){const{model:t}=this.page;t.scene&&t.scene!==this.known&&this.adopt(t.scene),this.cells.forEach((e,n)=>{const s=t.state?.seats[n];Ae(e.person,s?.person??Ti),Ae(e.state,rE(s)),e.state.classList.toggle("bad",s?.taken===!0&&s.heard===!1),be(e.remove,!t.may("remove")||s?.taken!==!0),e.remove.hidden=!t.granted("remove")}),this.drain.hidden=!t.granted("drain"),be(this.drain,!t.may("drain"))}adopt(t){this.known=t,this.cells=t.seats.map(e=>({person:z("td"),state:z("td"),remove:He(H("stop.remove"),()=>void this.askRemove(e.name),{"aria-label":`${H("stop.remove")} ${e.name}`})})),this.rows.replaceChildren(...t.seats.map((e,n)=>{const s=this.cells[n];return z("tr",{},z("th",{scope:"row"},ol(n),e.name),s?.person??null,z("td",{},hs("role",e.role)),z("td",{},e.device??Ti),s?.state??null,z("td",{class:"end"},s?.remove??null))}))}async askRemove(t){const e=z("input",{type:"text",maxlength:200}),n=H("who.remove_title",{seat:t}),s=await Du(n,"",e,H("who.reason"),H("stop.remove").replace("…",""),H("who.cancel"));s!==null&&this.page.order(n,{order:"remove",seat:t,why:s||H("stop.why")})}async askDrain(){const t=z("input",{type:"number",min:0,max:3600,step:1,value:"30",required:!0}),e=H("drain.title"),n=H("stop.drain").replace("…",""),s=await Du(e,H("drain.explain"),t,H("drain.grace"),n,H("who.cancel"));s!==null&&this.page.order(e,{order:"drain",grace_s:Math.round(Number(s))})}}class oE{constructor(t){this.page=t,this.slot=z("div",{class:"slot"});const e=new eS(t),n=new aE(t),s=new sE(t),r=new qd(t);this.parts=[e,n,s,r],this.node=z("div",{class:"view instructor-view"},z("div",{class:"column"},this.slot,r.node),z("div",{class:"column"},e.node,n.node),z("div",{class:"column wide"},s.node))}shown(){this.slot.append(this.page.pictureHost)}update(){for(const t of this.parts)t.update()}}class lE{constructor(t,e){this.joined=e,this.ticket=z("input",{type:"password",autocomplete:"off",required:!0,maxlength:4096}),this.name=z("input",{type:"text",autocomplete:"name",required:!0,maxlength:64}),this.go=z("button",{type:"submit",class:"primary"},H("join.go")),this.problem=z("p",{class:"problem",role:"alert"}),this.ticket.value=t?.ticket??"",this.name.value=t?.name??"",this.node=z("div",{class:"view join-view"},qn(H("join.title"),"join-panel",z("p",{},H("join.explain")),z("form",{onsubmit:n=>{n.preventDefault(),this.send()}},Ye(H("join.ticket"),this.ticket),Ye(H("join.name"),this.name),this.go),this.problem))}async send(){be(this.go,!0),Ae(this.problem,"");try{const t=await fetch("/join",{method:"POST",headers:{"Content-Type":"application/json"},body:JSON.stringify({ticket:this.ticket.value,name:this.name.value})});t.ok?(this.ticket.value="",this.joined()):Ae(this.problem,await cE(t))}catch{Ae(this.problem,H("join.failed"))}be(this.go,!1)}}async function cE(i){try{const t=await i.json();if(typeof t=="object"&&t!==null&&"text"in t&&typeof t.text=="string")return t.text.slice(0,500)}catch{}return`${H("join.failed")} (${i.status})`}const hE=4,uE=4e3;class Ud{constructor(){this.node=z("div",{class:"messages",role:"log","aria-live":"polite","aria-label":H("notices.title")})}show(t,e){[...this.node.children].find(r=>r.firstChild?.textContent===e)?.remove();const s=z("div",{class:`message ${t}`,role:t==="error"?"alert":void 0},z("p",{},e),He("✕",()=>s.remove(),{"aria-label":H("notices.dismiss"),class:"quiet"}));for(this.node.append(s);this.node.childElementCount>hE;)this.node.firstElementChild?.remove();t==="info"&&setTimeout(()=>s.remove(),uE)}}const Nd={type:"change"},cu={type:"start"},ym={type:"end"},bo=new Fh,kd=new es,fE=Math.cos(70*A_.DEG2RAD),tn=new j,kn=2*Math.PI,Te={NONE:-1,ROTATE:0,DOLLY:1,PAN:2,TOUCH_ROTATE:3,TOUCH_PAN:4,TOUCH_DOLLY_PAN:5,TOUCH_DOLLY_ROTATE:6},_c=1e-6;class dE extends Qy{constructor(t,e=null){super(t,e),this.state=Te.NONE,this.enabled=!0,this.target=new j,this.cursor=new j,this.minDistance=0,this.maxDistance=1/0,this.minZoom=0,this.maxZoom=1/0,this.minTargetRadius=0,this.maxTargetRadius=1/0,this.minPolarAngle=0,this.maxPolarAngle=Math.PI,this.minAzimuthAngle=-1/0,this.maxAzimuthAngle=1/0,this.enableDamping=!1,this.dampingFactor=.05,this.enableZoom=!0,this.zoomSpeed=1,this.enableRotate=!0,this.rotateSpeed=1,this.enablePan=!0,this.panSpeed=1,this.screenSpacePanning=!0,this.keyPanSpeed=7,this.zoomToCursor=!1,this.autoRotate=!1,this.autoRotateSpeed=2,this.keys={LEFT:"ArrowLeft",UP:"ArrowUp",RIGHT:"ArrowRight",BOTTOM:"ArrowDown"},this.mouseButtons={LEFT:Cr.ROTATE,MIDDLE:Cr.DOLLY,RIGHT:Cr.PAN},this.touches={ONE:br.ROTATE,TWO:br.DOLLY_PAN},this.target0=this.target.clone(),this.position0=this.object.position.clone(),this.zoom0=this.object.zoom,this._domElementKeyEvents=null,this._lastPosition=new j,this._lastQuaternion=new Bs,this._lastTargetPosition=new j,this._quat=new Bs().setFromUnitVectors(t.up,new j(0,1,0)),this._quatInverse=this._quat.clone().invert(),this._spherical=new zf,this._sphericalDelta=new zf,this._scale=1,this._panOffset=new j,this._rotateStart=new Qt,this._rotateEnd=new Qt,this._rotateDelta=new Qt,this._panStart=new Qt,this._panEnd=new Qt,this._panDelta=new Qt,this._dollyStart=new Qt,this._dollyEnd=new Qt,this._dollyDelta=new Qt,this._dollyDirection=new j,this._mouse=new Qt,this._performCursorZoom=!1,this._pointers=[],this._pointerPositions={},this._controlActive=!1,this._onPointerMove=mE.bind(this),this._onPointerDown=pE.bind(this),this._onPointerUp=gE.bind(this),this._onContextMenu=EE.bind(this),this._onMouseWheel=xE.bind(this),this._onKeyDown=ME.bind(this),this._onTouchStart=yE.bind(this),this._onTouchMove=SE.bind(this),this._onMouseDown=_E.bind(this),this._onMouseMove=vE.bind(this),this._interceptControlDown=wE.bind(this),this._interceptControlUp=bE.bind(this),this.domElement!==null&&this.connect(),this.update()}connect(){this.domElement.addEventListener("pointerdown",this._onPointerDown),this.domElement.addEventListener("pointercancel",this._onPointerUp),this.domElement.addEventListener("contextmenu",this._onContextMenu),this.domElement.addEventListener("wheel",this._onMouseWheel,{passive:!1}),this.domElement.getRootNode().addEventListener("keydown",this._interceptControlDown,{passive:!0,capture:!0}),this.domElement.style.touchAction="none"}disconnect(){this.domElement.removeEventListener("pointerdown",this._onPointerDown),this.domElement.removeEventListener("pointermove",this._onPointerMove),this.domElement.removeEventListener("pointerup",this._onPointerUp),this.domElement.removeEventListener("pointercancel",this._onPointerUp),this.domElement.removeEventListener("wheel",this._onMouseWheel),this.domElement.removeEventListener("contextmenu",this._onContextMenu),this.stopListenToKeyEvents(),this.domElement.getRootNode().removeEventListener("keydown",this._interceptControlDown,{capture:!0}),this.domElement.style.touchAction="auto"}dispose(){this.disconnect()}getPolarAngle(){return this._spherical.phi}getAzimuthalAngle(){return this._spherical.theta}getDistance(){return this.object.position.distanceTo(this.target)}listenToKeyEvents(t){t.addEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=t}stopListenToKeyEvents(){this._domElementKeyEvents!==null&&(this._domElementKeyEvents.removeEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=null)}saveState(){this.target0.copy(this.target),this.position0.copy(this.object.position),this.zoom0=this.object.zoom}reset(){this.target.copy(this.target0),this.object.position.copy(this.position0),this.object.zoom=this.zoom0,this.object.updateProjectionMatrix(),this.dispatchEvent(Nd),this.update(),this.state=Te.NONE}update(t=null){const e=this.object.position;tn.copy(e).sub(this.target),tn.applyQuaternion(this._quat),this._spherical.setFromVector3(tn),this.autoRotate&&this.state===Te.NONE&&this._rotateLeft(this._getAutoRotationAngle(t)),this.enableDamping?(this._spherical.theta+=this._sphericalDelta.theta*this.dampingFactor,this._spherical.phi+=this._sphericalDelta.phi*this.dampingFactor):(this._spherical.theta+=this._sphericalDelta.theta,this._spherical.phi+=this._sphericalDelta.phi);let n=this.minAzimuthAngle,s=this.maxAzimuthAngle;isFinite(n)&&isFinite(s)&&(n<-Math.PI?n+=kn:n>Math.PI&&(n-=kn),s<-Math.PI?s+=kn:s>Math.PI&&(s-=kn),n<=s?this._spherical.theta=Math.max(n,Math.min(s,this._spherical.theta)):this._spherical.theta=this._spherical.theta>(n+s)/2?Math.max(n,this._spherical.theta):Math.min(s,this._spherical.theta)),this._spherical.phi=Math.max(this.minPolarAngle,Math.min(this.maxPolarAngle,this._spherical.phi)),this._spherical.makeSafe(),this.enableDamping===!0?this.target.addScaledVector(this._panOffset,this.dampingFactor):this.target.add(this._panOffset),this.target.sub(this.cursor),this.target.clampLength(this.minTargetRadius,this.maxTargetRadius),this.target.add(this.cursor);let r=!1;if(this.zoomToCursor&&this._performCursorZoom||this.object.isOrthographicCamera)this._spherical.radius=this._clampDistance(this._spherical.radius);else{const a=this._spherical.radius;this._spherical.radius=this._clampDistance(this._spherical.radius*this._scale),r=a!=this._spherical.radius}if(tn.setFromSpherical(this._spherical),tn.applyQuaternion(this._quatInverse),e.copy(this.target).add(tn),this.object.lookAt(this.target),this.enableDamping===!0?(this._sphericalDelta.theta*=1-this.dampingFactor,this._sphericalDelta.phi*=1-this.dampingFactor,this._panOffset.multiplyScalar(1-this.dampingFactor)):(this._sphericalDelta.set(0,0,0),this._panOffset.set(0,0,0)),this.zoomToCursor&&this._performCursorZoom){let a=null;if(this.object.isPerspectiveCamera){const o=tn.length();a=this._clampDistance(o*this._scale);const l=o-a;this.object.position.addScaledVector(this._dollyDirection,l),this.object.updateMatrixWorld(),r=!!l}else if(this.object.isOrthographicCamera){const o=new j(this._mouse.x,this._mouse.y,0);o.unproject(this.object);const l=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),this.object.updateProjectionMatrix(),r=l!==this.object.zoom;const c=new j(this._mouse.x,this._mouse.y,0);c.unproject(this.object),this.object.position.sub(c).add(o),this.object.updateMatrixWorld(),a=tn.length()}else console.warn("WARNING: OrbitControls.js encountered an unknown camera type - zoom to cursor disabled."),this.zoomToCursor=!1;a!==null&&(this.screenSpacePanning?this.target.set(0,0,-1).transformDirection(this.object.matrix).multiplyScalar(a).add(this.object.position):(bo.origin.copy(this.object.position),bo.direction.set(0,0,-1).transformDirection(this.object.matrix),Math.abs(this.object.up.dot(bo.direction))<fE?this.object.lookAt(this.target):(kd.setFromNormalAndCoplanarPoint(this.object.up,this.target),bo.intersectPlane(kd,this.target))))}else if(this.object.isOrthographicCamera){const a=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),a!==this.object.zoom&&(this.object.updateProjectionMatrix(),r=!0)}return this._scale=1,this._performCursorZoom=!1,r||this._lastPosition.distanceToSquared(this.object.position)>_c||8*(1-this._lastQuaternion.dot(this.object.quaternion))>_c||this._lastTargetPosition.distanceToSquared(this.target)>_c?(this.dispatchEvent(Nd),this._lastPosition.copy(this.object.position),this._lastQuaternion.copy(this.object.quaternion),this._lastTargetPosition.copy(this.target),!0):!1}_getAutoRotationAngle(t){return t!==null?kn/60*this.autoRotateSpeed*t:kn/60/60*this.autoRotateSpeed}_getZoomScale(t){const e=Math.abs(t*.01);return Math.pow(.95,this.zoomSpeed*e)}_rotateLeft(t){this._sphericalDelta.theta-=t}_rotateUp(t){this._sphericalDelta.phi-=t}_panLeft(t,e){tn.setFromMatrixColumn(e,0),tn.multiplyScalar(-t),this._panOffset.add(tn)}_panUp(t,e){this.screenSpacePanning===!0?tn.setFromMatrixColumn(e,1):(tn.setFromMatrixColumn(e,0),tn.crossVectors(this.object.up,tn)),tn.multiplyScalar(t),this._panOffset.add(tn)}_pan(t,e){const n=this.domElement;if(this.object.isPerspectiveCamera){const s=this.object.position;tn.copy(s).sub(this.target);let r=tn.length();r*=Math.tan(this.object.fov/2*Math.PI/180),this._panLeft(2*t*r/n.clientHeight,this.object.matrix),this._panUp(2*e*r/n.clientHeight,this.object.matrix)}else this.object.isOrthographicCamera?(this._panLeft(t*(this.object.right-this.object.left)/this.object.zoom/n.clientWidth,this.object.matrix),this._panUp(e*(this.object.top-this.object.bottom)/this.object.zoom/n.clientHeight,this.object.matrix)):(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - pan disabled."),this.enablePan=!1)}_dollyOut(t){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale/=t:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_dollyIn(t){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale*=t:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_updateZoomParameters(t,e){if(!this.zoomToCursor)return;this._performCursorZoom=!0;const n=this.domElement.getBoundingClientRect(),s=t-n.left,r=e-n.top,a=n.width,o=n.height;this._mouse.x=s/a*2-1,this._mouse.y=-(r/o)*2+1,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()}_clampDistance(t){return Math.max(this.minDistance,Math.min(this.maxDistance,t))}_handleMouseDownRotate(t){this._rotateStart.set(t.clientX,t.clientY)}_handleMouseDownDolly(t){this._updateZoomParameters(t.clientX,t.clientX),this._dollyStart.set(t.clientX,t.clientY)}_handleMouseDownPan(t){this._panStart.set(t.clientX,t.clientY)}_handleMouseMoveRotate(t){this._rotateEnd.set(t.clientX,t.clientY),this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);const e=this.domElement;this._rotateLeft(kn*this._rotateDelta.x/e.clientHeight),this._rotateUp(kn*this._rotateDelta.y/e.clientHeight),this._rotateStart.copy(this._rotateEnd),this.update()}_handleMouseMoveDolly(t){this._dollyEnd.set(t.clientX,t.clientY),this._dollyDelta.subVectors(this._dollyEnd,this._dollyStart),this._dollyDelta.y>0?this._dollyOut(this._getZoomScale(this._dollyDelta.y)):this._dollyDelta.y<0&&this._dollyIn(this._getZoomScale(this._dollyDelta.y)),this._dollyStart.copy(this._dollyEnd),this.update()}_handleMouseMovePan(t){this._panEnd.set(t.clientX,t.clientY),this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd),this.update()}_handleMouseWheel(t){this._updateZoomParameters(t.clientX,t.clientY),t.deltaY<0?this._dollyIn(this._getZoomScale(t.deltaY)):t.deltaY>0&&this._dollyOut(this._getZoomScale(t.deltaY)),this.update()}_handleKeyDown(t){let e=!1;switch(t.code){case this.keys.UP:t.ctrlKey||t.metaKey||t.shiftKey?this._rotateUp(kn*this.rotateSpeed/this.domElement.clientHeight):this._pan(0,this.keyPanSpeed),e=!0;break;case this.keys.BOTTOM:t.ctrlKey||t.metaKey||t.shiftKey?this._rotateUp(-kn*this.rotateSpeed/this.domElement.clientHeight):this._pan(0,-this.keyPanSpeed),e=!0;break;case this.keys.LEFT:t.ctrlKey||t.metaKey||t.shiftKey?this._rotateLeft(kn*this.rotateSpeed/this.domElement.clientHeight):this._pan(this.keyPanSpeed,0),e=!0;break;case this.keys.RIGHT:t.ctrlKey||t.metaKey||t.shiftKey?this._rotateLeft(-kn*this.rotateSpeed/this.domElement.clientHeight):this._pan(-this.keyPanSpeed,0),e=!0;break}e&&(t.preventDefault(),this.update())}_handleTouchStartRotate(t){if(this._pointers.length===1)this._rotateStart.set(t.pageX,t.pageY);else{const e=this._getSecondPointerPosition(t),n=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._rotateStart.set(n,s)}}_handleTouchStartPan(t){if(this._pointers.length===1)this._panStart.set(t.pageX,t.pageY);else{const e=this._getSecondPointerPosition(t),n=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._panStart.set(n,s)}}_handleTouchStartDolly(t){const e=this._getSecondPointerPosition(t),n=t.pageX-e.x,s=t.pageY-e.y,r=Math.sqrt(n*n+s*s);this._dollyStart.set(0,r)}_handleTouchStartDollyPan(t){this.enableZoom&&this._handleTouchStartDolly(t),this.enablePan&&this._handleTouchStartPan(t)}_handleTouchStartDollyRotate(t){this.enableZoom&&this._handleTouchStartDolly(t),this.enableRotate&&this._handleTouchStartRotate(t)}_handleTouchMoveRotate(t){if(this._pointers.length==1)this._rotateEnd.set(t.pageX,t.pageY);else{const n=this._getSecondPointerPosition(t),s=.5*(t.pageX+n.x),r=.5*(t.pageY+n.y);this._rotateEnd.set(s,r)}this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);const e=this.domElement;this._rotateLeft(kn*this._rotateDelta.x/e.clientHeight),this._rotateUp(kn*this._rotateDelta.y/e.clientHeight),this._rotateStart.copy(this._rotateEnd)}_handleTouchMovePan(t){if(this._pointers.length===1)this._panEnd.set(t.pageX,t.pageY);else{const e=this._getSecondPointerPosition(t),n=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._panEnd.set(n,s)}this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd)}_handleTouchMoveDolly(t){const e=this._getSecondPointerPosition(t),n=t.pageX-e.x,s=t.pageY-e.y,r=Math.sqrt(n*n+s*s);this._dollyEnd.set(0,r),this._dollyDelta.set(0,Math.pow(this._dollyEnd.y/this._dollyStart.y,this.zoomSpeed)),this._dollyOut(this._dollyDelta.y),this._dollyStart.copy(this._dollyEnd);const a=(t.pageX+e.x)*.5,o=(t.pageY+e.y)*.5;this._updateZoomParameters(a,o)}_handleTouchMoveDollyPan(t){this.enableZoom&&this._handleTouchMoveDolly(t),this.enablePan&&this._handleTouchMovePan(t)}_handleTouchMoveDollyRotate(t){this.enableZoom&&this._handleTouchMoveDolly(t),this.enableRotate&&this._handleTouchMoveRotate(t)}_addPointer(t){this._pointers.push(t.pointerId)}_removePointer(t){delete this._pointerPositions[t.pointerId];for(let e=0;e<this._pointers.length;e++)if(this._pointers[e]==t.pointerId){this._pointers.splice(e,1);return}}_isTrackingPointer(t){for(let e=0;e<this._pointers.length;e++)if(this._pointers[e]==t.pointerId)return!0;return!1}_trackPointer(t){let e=this._pointerPositions[t.pointerId];e===void 0&&(e=new Qt,this._pointerPositions[t.pointerId]=e),e.set(t.pageX,t.pageY)}_getSecondPointerPosition(t){const e=t.pointerId===this._pointers[0]?this._pointers[1]:this._pointers[0];return this._pointerPositions[e]}_customWheelEvent(t){const e=t.deltaMode,n={clientX:t.clientX,clientY:t.clientY,deltaY:t.deltaY};switch(e){case 1:n.deltaY*=16;break;case 2:n.deltaY*=100;break}return t.ctrlKey&&!this._controlActive&&(n.deltaY*=10),n}}function pE(i){this.enabled!==!1&&(this._pointers.length===0&&(this.domElement.setPointerCapture(i.pointerId),this.domElement.addEventListener("pointermove",this._onPointerMove),this.domElement.addEventListener("pointerup",this._onPointerUp)),!this._isTrackingPointer(i)&&(this._addPointer(i),i.pointerType==="touch"?this._onTouchStart(i):this._onMouseDown(i)))}function mE(i){this.enabled!==!1&&(i.pointerType==="touch"?this._onTouchMove(i):this._onMouseMove(i))}function gE(i){switch(this._removePointer(i),this._pointers.length){case 0:this.domElement.releasePointerCapture(i.pointerId),this.domElement.removeEventListener("pointermove",this._onPointerMove),this.domElement.removeEventListener("pointerup",this._onPointerUp),this.dispatchEvent(ym),this.state=Te.NONE;break;case 1:const t=this._pointers[0],e=this._pointerPositions[t];this._onTouchStart({pointerId:t,pageX:e.x,pageY:e.y});break}}function _E(i){let t;switch(i.button){case 0:t=this.mouseButtons.LEFT;break;case 1:t=this.mouseButtons.MIDDLE;break;case 2:t=this.mouseButtons.RIGHT;break;default:t=-1}switch(t){case Cr.DOLLY:if(this.enableZoom===!1)return;this._handleMouseDownDolly(i),this.state=Te.DOLLY;break;case Cr.ROTATE:if(i.ctrlKey||i.metaKey||i.shiftKey){if(this.enablePan===!1)return;this._handleMouseDownPan(i),this.state=Te.PAN}else{if(this.enableRotate===!1)return;this._handleMouseDownRotate(i),this.state=Te.ROTATE}break;case Cr.PAN:if(i.ctrlKey||i.metaKey||i.shiftKey){if(this.enableRotate===!1)return;this._handleMouseDownRotate(i),this.state=Te.ROTATE}else{if(this.enablePan===!1)return;this._handleMouseDownPan(i),this.state=Te.PAN}break;default:this.state=Te.NONE}this.state!==Te.NONE&&this.dispatchEvent(cu)}function vE(i){switch(this.state){case Te.ROTATE:if(this.enableRotate===!1)return;this._handleMouseMoveRotate(i);break;case Te.DOLLY:if(this.enableZoom===!1)return;this._handleMouseMoveDolly(i);break;case Te.PAN:if(this.enablePan===!1)return;this._handleMouseMovePan(i);break}}function xE(i){this.enabled===!1||this.enableZoom===!1||this.state!==Te.NONE||(i.preventDefault(),this.dispatchEvent(cu),this._handleMouseWheel(this._customWheelEvent(i)),this.dispatchEvent(ym))}function ME(i){this.enabled===!1||this.enablePan===!1||this._handleKeyDown(i)}function yE(i){switch(this._trackPointer(i),this._pointers.length){case 1:switch(this.touches.ONE){case br.ROTATE:if(this.enableRotate===!1)return;this._handleTouchStartRotate(i),this.state=Te.TOUCH_ROTATE;break;case br.PAN:if(this.enablePan===!1)return;this._handleTouchStartPan(i),this.state=Te.TOUCH_PAN;break;default:this.state=Te.NONE}break;case 2:switch(this.touches.TWO){case br.DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchStartDollyPan(i),this.state=Te.TOUCH_DOLLY_PAN;break;case br.DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchStartDollyRotate(i),this.state=Te.TOUCH_DOLLY_ROTATE;break;default:this.state=Te.NONE}break;default:this.state=Te.NONE}this.state!==Te.NONE&&this.dispatchEvent(cu)}function SE(i){switch(this._trackPointer(i),this.state){case Te.TOUCH_ROTATE:if(this.enableRotate===!1)return;this._handleTouchMoveRotate(i),this.update();break;case Te.TOUCH_PAN:if(this.enablePan===!1)return;this._handleTouchMovePan(i),this.update();break;case Te.TOUCH_DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchMoveDollyPan(i),this.update();break;case Te.TOUCH_DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchMoveDollyRotate(i),this.update();break;default:this.state=Te.NONE}}function EE(i){this.enabled!==!1&&i.preventDefault()}function wE(i){i.key==="Control"&&(this._controlActive=!0,this.domElement.getRootNode().addEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}function bE(i){i.key==="Control"&&(this._controlActive=!1,this.domElement.getRootNode().removeEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}const TE=.25,To=.12;class AE{constructor(t){this.camera=new Qn(38,1,.01,3),this.chosen="free",this.goal=new j,this.target=new j,this.zoom=1,this.camera.up.set(0,0,1),this.controls=new dE(this.camera,t),this.controls.enablePan=!1,this.controls.enableDamping=!1,this.controls.minDistance=.06,this.controls.maxDistance=.8,t.addEventListener("keydown",e=>this.onKey(e)),this.choose("free")}get choice(){return this.chosen}choose(t){this.chosen=t,this.zoom=1,this.controls.enabled=t==="free",this.controls.target.set(0,0,0),t==="free"&&this.camera.position.set(.1,-.2,.1),this.controls.update()}resize(t){this.camera.aspect=t,this.camera.fov=t<1.2?Math.min(75,38*(1.2/t)):38,this.camera.updateProjectionMatrix()}update(t,e){if(this.chosen==="free")return;const n=TE/this.zoom;if(this.chosen==="front")this.place([0,-n,.02],[0,0,0],1);else if(this.chosen==="above")this.place([0,-.001,n],[0,0,0],1);else if(t){const s=[t[0],t[1]-.6*n,t[2]+.25*n];this.place(s,t,e?1:.12)}}place(t,e,n){this.goal.set(...t),this.camera.position.lerp(this.goal,n),this.target.lerp(this.goal.set(...e),n),this.camera.lookAt(this.target)}onKey(t){const n={ArrowLeft:[-To,0],ArrowRight:[To,0],ArrowUp:[0,To],ArrowDown:[0,-To]}[t.key];if(t.key==="+"||t.key==="-"){const s=t.key==="+"?1.15:.8695652173913044;this.zoom=Math.min(4,Math.max(.4,this.zoom*s)),this.chosen==="free"&&this.camera.position.multiplyScalar(1/s).clampLength(.06,.8)}else if(n&&this.chosen==="free"){const{x:s,y:r,z:a}=this.camera.position,[o,l]=[Math.hypot(s,r,a),Math.atan2(r,s)+n[0]],c=Math.min(1.45,Math.max(-1.45,Math.asin(a/o)+n[1])),u=o*Math.cos(c);this.camera.position.set(u*Math.cos(l),u*Math.sin(l),o*Math.sin(c))}else return;this.controls.update(),t.preventDefault(),t.stopPropagation()}}const RE=.06,CE=.02;class Sm{constructor(){this.arrow=new Jy(new j(1,0,0),new j,.01),this.direction=new j}set(t,e,n,s,r){const a=e?Math.hypot(...e):0;if(this.arrow.visible=r&&t!==null&&e!==null&&a>CE&&Number.isFinite(a),!this.arrow.visible||!t||!e)return;const o=Math.min(RE,a*n);this.arrow.position.set(t[0],t[1],t[2]),this.arrow.setDirection(this.direction.set(e[0]/a,e[1]/a,e[2]/a)),this.arrow.setLength(o,Math.min(.004,o*.5),.0026),this.arrow.setColor(s)}dispose(){this.arrow.dispose()}}function PE(i){const t=Math.max(.1,i/4),e=10**Math.floor(Math.log10(t)+1e-9);return([1,2,5,10].find(s=>s*e>=t*(1-1e-9))??10)*e}const Od=.0075,LE=40;class DE{constructor(){this.canvas=document.createElement("canvas"),this.texture=new Xy(this.canvas),this.shown="",this.texture.minFilter=ti,this.texture.generateMipmaps=!1,this.sprite=new Wy(new Rp({map:this.texture,depthTest:!1,transparent:!0})),this.sprite.renderOrder=10}set(t,e,n,s){const r=[t,e,n,s].join(`
`);if(r===this.shown)return;this.shown=r;const a=this.canvas.getContext("2d");if(!a)return;const o=`600 ${LE}px system-ui, sans-serif`;a.font=o,this.canvas.width=Math.min(1024,Math.ceil(a.measureText(t).width)+64),this.canvas.height=64,a.font=o,a.globalAlpha=.88,a.fillStyle=n,a.beginPath(),a.roundRect(0,0,this.canvas.width,64,14),a.fill(),a.globalAlpha=1,a.fillStyle=s,a.beginPath(),a.roundRect(10,12,14,40,7),a.fill(),a.fillStyle=e,a.textBaseline="middle",a.fillText(t,36,34),this.texture.dispose(),this.texture.needsUpdate=!0,this.sprite.scale.set(Od*this.canvas.width/64,Od,1)}dispose(){this.texture.dispose(),this.sprite.material.dispose()}}const vc=3,ba=180;class IE{constructor(){this.points=new Ra(ba)}get length(){return this.points.length}clear(){this.points.clear()}push(t,e){const n=this.points.newest;n&&t<n.t&&this.clear(),this.points.dropWhile(s=>t-s.t>vc),e!==null&&(n&&t-n.t<vc/ba-1e-9&&this.points.length>0||this.points.push({t,x:e}))}write(t,e,n){const s=Math.min(this.points.length,e.length,Math.floor(t.length/3));for(let r=0;r<s;r+=1){const a=this.points.at(r);a&&(t.set(a.x,3*r),e[r]=Math.max(0,1-(n-a.t)/vc))}return s}}class Em{constructor(){this.trail=new IE,this.positions=new Float32Array(3*ba),this.shares=new Float32Array(ba),this.colours=new Float32Array(3*ba),this.geometry=new gn,this.mixed=new ne,this.geometry.setAttribute("position",new Wn(this.positions,3)),this.geometry.setAttribute("color",new Wn(this.colours,3)),this.line=new Hh(this.geometry,new Da({vertexColors:!0})),this.line.frustumCulled=!1}update(t,e,n,s,r){if(this.trail.push(t,e),this.line.visible=r,!r)return;const a=this.trail.write(this.positions,this.shares,t);for(let o=0;o<a;o+=1)this.mixed.lerpColors(s,n,this.shares[o]??0).toArray(this.colours,3*o);this.geometry.setDrawRange(0,a);for(const o of Object.values(this.geometry.attributes))o.needsUpdate=!0}dispose(){this.geometry.dispose(),this.line.material.dispose()}}const UE=new al(.0042,20,14),NE=new sl(.0017,.0026,.02,12),kE=new Vh(.0066,7e-4,6,24);class OE{constructor(t){this.index=t,this.group=new di,this.body=new di,this.label=new DE,this.force=new Sm,this.trail=new Em,this.colour=new ne(jo(t)),this.material=new Wh({color:this.colour,transparent:!0,opacity:.62});const e=new rn(NE,this.material);e.rotation.set(Math.PI/2+.6,0,0),e.position.set(0,-.006,.009),this.ring=new rn(kE,new Xr({color:"#b42318"})),this.body.add(new rn(UE,this.material),e,this.ring,this.label.sprite),this.group.add(this.body,this.force.arrow,this.trail.line)}update(t,e,n,s,r){const a=t.x!==null&&t.taken!==!1;if(this.body.visible=a,this.trail.update(n,a?t.x:null,this.colour,s.background,r.trails),this.force.set(a?t.x:null,t.f,r.forceScale,this.colour,r.forces),!a||!t.x)return;this.body.position.set(t.x[0],t.x[1],t.x[2]),this.material.opacity=t.heard===!1?.2:t.engaged===!1?.34:.72;const o=jh(t,e);this.ring.visible=o,o&&(this.ring.material.color.copy(s.limit),this.ring.scale.setScalar(r.reducedMotion?1.2:1.15+.2*Math.abs(Math.sin(n*6)))),this.label.sprite.visible=r.names;const l=e?.name??String(this.index+1);this.label.set(o?`${l} · ${H("picture.limit")}`:l,s.text,s.label,o?`#${s.limit.getHexString()}`:jo(this.index)),this.label.sprite.position.set(0,0,.024+.0095*(this.index%4))}face(t){this.ring.quaternion.copy(t)}dispose(){this.material.dispose(),this.ring.material.dispose(),this.label.dispose(),this.force.dispose(),this.trail.dispose()}}const xc=.12,Fd=.012;function Bd(i,t,e){const n=[xc,xc,xc];n[i.axis]=Fd;const s=new qr(...n),r=t==="wall"?e.wall:e.tissue,a=new rn(s,new Wh({color:r,transparent:!0,opacity:t==="wall"?.42:.3,depthWrite:!1})),o=new Gh(new qy(s),new Da({color:r})),l=new di;l.add(a,o);const c=i.from_below?1:-1;return l.position.setComponent(i.axis,i.at_m+c*Fd/2),l}function FE(i,t){const e=new di,n=new Zy(.2,20,t.grid,t.grid);n.rotation.x=Math.PI/2,n.position.z=-.065,e.add(n);for(const s of i){for(const r of s.walls)e.add(Bd(r,"wall",t));for(const r of s.tissues)e.add(Bd(r,"tissue",t))}return e}function BE(i){i.traverse(t=>{if(t instanceof rn||t instanceof Gh){t.geometry.dispose();for(const e of[t.material].flat())e.dispose()}})}const zE=new al(.003,20,14),HE=new rl(.0045,.0062,32),GE=.0092,VE=.0112,Mc=.06;class WE{constructor(){this.group=new di,this.shown=""}update(t,e){const n=t.map(r=>Math.round(r*200)).join(",")+e.join(",");if(n===this.shown)return;this.shown=n,this.clear();let s=Math.PI/2;t.forEach((r,a)=>{const o=r*2*Math.PI;if(o>Mc*1.5){const l=new rl(GE,VE,48,1,s-o+Mc/2,o-Mc);this.group.add(new rn(l,new Xr({color:jo(e[a]??a),side:2})))}s-=o})}clear(){for(const t of[...this.group.children])t instanceof rn&&(t.geometry.dispose(),t.material.dispose()),this.group.remove(t)}}function XE(i,t){const e=[...i];for(const n of[...t?.walls??[],...t?.tissues??[]])(n.from_below?i[n.axis]>=n.at_m:i[n.axis]<=n.at_m)&&(e[n.axis]=n.at_m);return e}class qE{constructor(){this.group=new di,this.body=new di,this.material=new Wh,this.bars=new WE,this.contact=new rn(HE,new Xr({side:2})),this.force=new Sm,this.trail=new Em,this.colour=new ne,this.body.add(new rn(zE,this.material),this.bars.group),this.group.add(this.body,this.contact,this.force.arrow,this.trail.line)}update(t,e,n,s,r,a){const o=t.x,l=t.touching===!0&&o!==null;this.body.visible=o!==null,this.contact.visible=l,this.colour.copy(l?r.contact:r.tool),this.material.color.copy(this.colour),this.trail.update(n.t,o,this.colour,r.background,a.trails),this.force.set(o,t.f,a.forceScale,this.colour,a.forces),o&&(this.body.position.set(o[0],o[1],o[2]),this.bars.update(t.applied??t.wanted??[],s),l&&(this.contact.material.color.copy(r.contact),this.contact.position.set(...XE(o,e)),this.contact.scale.setScalar(1+Math.min(2,(t.depth_m??0)/.002))))}face(t){this.bars.group.quaternion.copy(t),this.contact.quaternion.copy(t)}dispose(){this.bars.clear(),this.material.dispose(),this.contact.material.dispose(),this.force.dispose(),this.trail.dispose()}}const yc=26,Ao=14,zd=.5,YE=3.3;class jE{constructor(t){this.canvas=document.createElement("canvas"),this.options={trails:!0,forces:!0,names:!0,forceScale:.01,reducedMotion:!1},this.scene=new Gy,this.surfaces=null,this.hands=new Map,this.tools=new Map,this.known=null,this.ratio=Math.min(2,window.devicePixelRatio||1),this.frameTime=Ao,this.last=0,this.size="",this.frames=0,this.canvas.tabIndex=0,this.canvas.setAttribute("role","img"),this.canvas.setAttribute("aria-label",t),this.renderer=new Hy({canvas:this.canvas,antialias:this.ratio<1.5,powerPreference:"low-power"}),this.colours=Gf(document.documentElement),this.rig=new AE(this.canvas);const e=new Ky("#ffffff",2);e.position.set(.2,-.4,.6),this.scene.add(new $y("#ffffff",1.6),e)}get forceOf10mm(){return .01/this.options.forceScale}recolour(){this.colours=Gf(document.documentElement),this.known=null}draw(t,e,n){this.fit()&&(this.adapt(n),t&&t!==this.known&&this.adopt(t),t&&e&&this.update(t,e),this.renderer.render(this.scene,this.rig.camera),this.frames+=1)}adopt(t){const e=this.known?.session!==t.session;this.known=t,this.scene.background=this.colours.background,this.surfaces&&(this.scene.remove(this.surfaces),BE(this.surfaces)),this.surfaces=FE(t.tools,this.colours),this.scene.add(this.surfaces),e&&this.clear();const n=t.seats.map(s=>s.force_limit_n??0);this.options.forceScale=.01/PE(Math.max(...n,0)||YE)}clear(){for(const t of[...this.hands.values(),...this.tools.values()])this.scene.remove(t.group),t.dispose();this.hands.clear(),this.tools.clear()}update(t,e){const n=t.seats.map((a,o)=>a.kind==="MASTER"?o:-1).filter(a=>a>=0);e.seats.forEach((a,o)=>{t.seats[o]?.kind!=="SLAVE"&&this.hand(o).update(a,t.seats[o],e.t,this.colours,this.options)}),e.tools.forEach((a,o)=>{this.tool(o).update(a,t.tools[o],e,n,this.colours,this.options)});const s=this.rig.choice,r=s.startsWith("seat:")?e.seats[Number(s.slice(5))]:void 0;this.rig.update(r?.x??null,this.options.reducedMotion);for(const a of[...this.hands.values(),...this.tools.values()])a.face(this.rig.camera.quaternion)}hand(t){const e=this.hands.get(t);if(e)return e;const n=new OE(t);return this.hands.set(t,n),this.scene.add(n.group),n}tool(t){const e=this.tools.get(t);if(e)return e;const n=new qE;return this.tools.set(t,n),this.scene.add(n.group),n}fit(){const t=this.canvas.parentElement;if(!t)return!1;const[e,n]=[t.clientWidth,t.clientHeight];if(e<2||n<2)return!1;const s=`${e} ${n} ${this.ratio}`;return s===this.size||(this.size=s,this.renderer.setPixelRatio(this.ratio),this.renderer.setSize(e,n),this.rig.resize(e/n)),!0}adapt(t){const e=t-this.last;if(this.last=t,!(e>0&&e<250))return;this.frameTime+=(e-this.frameTime)*.05;const n=Math.min(2,window.devicePixelRatio||1);this.frameTime>yc&&this.ratio>zd?(this.ratio=Math.max(zd,this.ratio*.8),this.frameTime=(yc+Ao)/2):this.frameTime<Ao&&this.ratio<n&&(this.ratio=Math.min(n,this.ratio*1.1),this.frameTime=(yc+Ao)/2)}}class KE{constructor(t){this.model=t,this.delay=z("p",{class:"delay"}),this.scale=z("p",{class:"scale"}),this.phase=z("p",{class:"phase-banner"}),this.shownDelay=NaN;let e=null;try{e=new jE(H("picture.label"))}catch{}this.picture=e,this.node=z("div",{class:"picture"},e?.canvas??z("p",{class:"no-picture"},H("picture.none"))),this.node.append(z("div",{class:"overlay"},this.delay,this.scale,this.phase));const n=matchMedia("(prefers-reduced-motion: reduce)"),s=()=>{e&&(e.options.reducedMotion=n.matches,n.matches&&(e.options.trails=!1))};n.addEventListener("change",s),s()}frame(t,e){if(this.node.isConnected&&this.picture?.draw(this.model.scene,t?.state??null,e),t){const n=Number.isNaN(this.shownDelay)?1:.1;this.shownDelay=(Number.isNaN(this.shownDelay)?0:this.shownDelay*(1-n))+t.delay_ms*n}}update(t){const{dropped:e}=this.model.acknowledgements,{skipped:n}=this.model.states,s=t?.outOfDate??!1;(s||!t)&&(this.shownDelay=NaN),Ae(this.delay,t?s?H("delay.old",{s:nn(t.silence_ms/1e3,1,"s")}):H("delay.value",{ms:nn(this.shownDelay,0,"ms")}):H("delay.none")),as(this.delay,"title",H("delay.help",{dropped:e,skipped:n})),this.node.classList.toggle("out-of-date",s);const r=this.picture?.forceOf10mm??0;Ae(this.scale,this.picture?.options.forces?H("picture.scale",{n:nn(r,r<1?1:0)}):"");const a=t?.state.phase??"RUNNING";Ae(this.phase,a==="RUNNING"?"":hs("phase",a)),this.phase.hidden=a==="RUNNING"}}const rs=.06,$E=.005,ZE=.12,Sc=.12,JE=45,Sr=i=>Number.isFinite(i)?Math.min(rs,Math.max(-rs,i)):0;class QE{constructor(){this.position=[0,0,0],this.grips=new Set,this.plane="front"}get x(){return[...this.position]}get pressed(){return this.grips.size>0}grip(t,e){e?this.grips.add(t):this.grips.delete(t)}release(){this.grips.clear()}moveTo(t){this.position=[Sr(t[0]),Sr(t[1]),Sr(t[2])]}pointAt(t,e){this.position[0]=Sr(t*rs),this.position[this.vertical()]=Sr(e*rs)}step(t,e){this.position[t]=Sr(this.position[t]+e)}stick(t,e){const n=Math.min(.1,Math.max(0,e));t.forEach((s,r)=>{const a=Math.abs(s);if(!(a>Sc))return;const o=Math.sign(s)*((Math.min(1,a)-Sc)/(1-Sc));this.step(r,o*ZE*n)})}place(t){return[t[0]/rs,t[this.vertical()]/rs]}vertical(){return this.plane==="front"?2:1}}const tw={ArrowLeft:[-1,0,0],ArrowRight:[1,0,0],ArrowDown:[0,-1,0],ArrowUp:[0,1,0],PageDown:[0,0,-1],PageUp:[0,0,1]};class ew{constructor(t){this.device=t,this.canvas=z("canvas",{class:"pad",tabindex:0,role:"application","aria-label":H("seat.pad")});const e=n=>{const s=this.canvas.getBoundingClientRect(),r=Math.min(s.width,s.height)/2;t.pointAt((n.clientX-s.left-s.width/2)/r,-(n.clientY-s.top-s.height/2)/r)};this.canvas.addEventListener("pointerdown",n=>{this.canvas.setPointerCapture(n.pointerId),t.grip("pointer",!0),e(n)}),this.canvas.addEventListener("pointermove",n=>{this.canvas.hasPointerCapture(n.pointerId)&&e(n)});for(const n of["pointerup","pointercancel","lostpointercapture"])this.canvas.addEventListener(n,()=>t.grip("pointer",!1));this.canvas.addEventListener("keydown",n=>this.onKey(n)),window.addEventListener("blur",()=>t.release())}draw(t,e){const n=Math.min(2,window.devicePixelRatio||1),[s,r]=[this.canvas.clientWidth,this.canvas.clientHeight];if(s<2||r<2)return;this.canvas.width!==Math.round(s*n)&&(this.canvas.width=Math.round(s*n)),this.canvas.height!==Math.round(r*n)&&(this.canvas.height=Math.round(r*n));const a=this.canvas.getContext("2d");if(!a)return;const o=getComputedStyle(this.canvas),l=M=>o.getPropertyValue(M).trim();a.setTransform(n,0,0,n,0,0),a.clearRect(0,0,s,r);const c=Math.min(s,r)/2,u=M=>{const[p,d]=this.device.place(M);return[s/2+p*c,r/2-d*c]};this.grid(a,s,r,c,l("--picture-grid"));const f=u(this.device.x),h=t?.x?u(t.x):null,_=e??0,x=_>=.999?"--red":_>=.8?"--amber":"--accent";h&&(a.strokeStyle=l(x),a.lineWidth=3+5*Math.min(1,_),a.beginPath(),a.moveTo(...f),a.lineTo(...h),a.stroke(),a.fillStyle=l(x),a.beginPath(),a.arc(...h,12,0,2*Math.PI),a.fill()),a.strokeStyle=l("--text"),a.lineWidth=2,a.setLineDash(this.device.pressed?[]:[5,5]),a.beginPath(),a.arc(...f,18,0,2*Math.PI),a.stroke(),a.setLineDash([])}grid(t,e,n,s,r){t.strokeStyle=r,t.lineWidth=1,t.beginPath();const a=.02/rs*s;for(let o=-Math.ceil(e/2/a);o<=e/2/a;o+=1)t.moveTo(e/2+o*a,0),t.lineTo(e/2+o*a,n);for(let o=-Math.ceil(n/2/a);o<=n/2/a;o+=1)t.moveTo(0,n/2+o*a),t.lineTo(e,n/2+o*a);t.stroke()}onKey(t){const e=tw[t.key];if(t.key===" ")t.repeat||this.device.grip("key",!this.device.pressed);else if(e){const n=this.device.plane==="front"?[0,2,1]:[0,1,2];e.forEach((s,r)=>this.device.step(n[r]??0,s*$E))}else return;t.preventDefault(),t.stopPropagation()}}class nw{constructor(t){this.page=t,this.device=new QE,this.pad=new ew(this.device),this.slot=z("div",{class:"slot"}),this.choice=ii([],"",()=>{}),this.words=z("p",{role:"status"}),this.force=z("meter",{min:0,max:1,low:.8,high:.999,optimum:0,"aria-label":H("seat.force")}),this.forceText=z("output"),this.gamepad=z("p",{class:"note"},H("seat.gamepad")),this.options="",this.sent_ms=0,this.last_ms=0,this.seat="",this.take=He(H("seat.take"),()=>this.takeSeat(),{class:"primary"}),this.leave=He(H("seat.leave"),()=>void this.page.request(H("seat.leave"),{type:"leave"})),this.hold=He(H("seat.hold"),()=>this.device.grip("button",!this.device.pressed),{"aria-pressed":"false"});const e=ii([["front",H("seat.front")],["above",H("seat.above")]],"front",r=>{this.device.plane=r,Ae(this.depthLabel,H(r==="front"?"seat.depth_front":"seat.depth_above"))}),n=rs*1e3;this.depth=z("input",{type:"range",min:-n,max:n,step:1,value:"0",oninput:()=>this.moveDepth(Number(this.depth.value)/1e3)});const s=Ye(H("seat.depth_front"),this.depth);this.depthLabel=s.querySelector("span")??s,this.node=z("div",{class:"view seat-view"},z("div",{class:"column"},qn(H("seat.title"),"seat-panel",z("div",{class:"row"},Ye(H("seat.choose"),this.choice),this.take,this.leave),this.words,this.pad.canvas,z("div",{class:"row"},this.hold,Ye(H("seat.plane"),e),s),z("div",{class:"force"},z("span",{},H("seat.force")),this.force,this.forceText),z("p",{class:"note"},H("seat.explain")),this.gamepad)),z("div",{class:"column"},this.slot))}shown(){this.slot.append(this.page.pictureHost)}hidden(){this.device.release(),this.page.sound.ownForce(null)}update(){const{model:t}=this.page,e=t.ownSeat?.seat??"";e!==this.seat&&(this.seat=e,t.ownSeat?.x&&this.device.moveTo(t.ownSeat.x));const n=(t.scene?.seats??[]).filter((o,l)=>o.kind==="MASTER"&&t.state?.seats[l]?.taken===!1),s=n.map(o=>o.name).join(`
`);s!==this.options&&(this.options=s,ks(this.choice,n.map(o=>[o.name,o.name]),this.choice.value));const r=t.may("seat");be(this.take,!r||e!==""||n.length===0),be(this.choice,!r||e!==""||n.length===0),be(this.leave,e===""||!r),be(this.hold,e===""),be(this.depth,e===""),this.hold.setAttribute("aria-pressed",String(this.device.pressed));const a=H(this.device.pressed?"seat.held":"seat.released");Ae(this.words,e!==""?`${H("seat.yours",{seat:e})} ${a}`:H(t.granted("seat")?n.length===0?"seat.none_free":"seat.explain":"seat.not_allowed"))}frame(t,e){const{model:n}=this.page,s=n.ownSeat;this.readGamepad((e-this.last_ms)/1e3),this.last_ms=e,s&&e-this.sent_ms>=1e3/JE&&(this.sent_ms=e,this.page.connection.signal({type:"pointer",x:this.device.x,pressed:this.device.pressed}));const r=n.scene?.seats.find(c=>c.name===s?.seat)?.force_limit_n??null,a=s?.f?Math.hypot(...s.f):null,o=a===null||r===null?null:a/r;this.force.value=Math.min(1,o??0),Ae(this.forceText,nn(a,2,"N"));const l=this.device.plane==="front"?1:2;document.activeElement!==this.depth&&(this.depth.value=String(Math.round((this.device.x[l]??0)*1e3))),this.pad.draw(s,o),this.page.sound.ownForce(s?o:null)}takeSeat(){this.choice.value&&this.page.request(H("seat.take"),{type:"take",seat:this.choice.value})}moveDepth(t){const e=this.device.plane==="front"?1:2;this.device.step(e,t-this.device.x[e])}readGamepad(t){const e=navigator.getGamepads?.().find(s=>s!==null&&s.connected)??null;if(Ae(this.gamepad,H(e?"seat.gamepad_on":"seat.gamepad")+(e?` ${H("seat.gamepad")}`:"")),!e)return;const n=s=>e.axes[s]??0;this.device.stick([n(0),-n(3),-n(1)],t),this.device.grip("gamepad",e.buttons[0]?.pressed??!1)}}const wm=["live","instructor","evaluator","seat","desk"];function iw(i){const t=mg();Oo(i);const e=H("language.name");return Oo(t),e}class sw{constructor(t,e,n){this.page=t,this.phase=z("span",{class:"badge"}),this.time=z("span",{class:"time"}),this.link=z("span",{class:"link",role:"status"}),this.person=z("span",{class:"person"}),this.known=null,this.session=ii([],"",l=>{t.request(H("bar.session"),{type:"watch",session:l})}),this.tabs=wm.map((l,c)=>He(H(`nav.${l}`),()=>n.choose(l),{"data-view":l,"aria-keyshortcuts":String(c+1)}));const s=ii(Object.keys(Th).map(l=>[l,iw(l)]),e.language,l=>n.change({language:l})),r=ii(["auto","light","dark"].map(l=>[l,H(`theme.${l}`)]),e.theme,l=>n.change({theme:l})),a=z("details",{class:"settings"},z("summary",{},H("bar.settings")),z("div",{class:"settings-box"},Ye(H("bar.language"),s),Ye(H("bar.theme"),r),wc(H("bar.keys"),e.keys,l=>n.change({keys:l})),z("p",{class:"note"},H("bar.keys_help")))),o=wc(H("bar.sound"),t.sound.on,l=>t.sound.switch(l));this.node=z("header",{class:"top-bar"},z("div",{class:"identity"},z("h1",{},"Tandem"),Ye(H("bar.session"),this.session),this.phase,this.time,this.link,this.person,o,a),z("nav",{"aria-label":H("nav.label")},...this.tabs))}choose(t){for(const e of this.tabs)as(e,"aria-current",e.dataset.view===t?"page":null)}update(){const{model:t}=this.page,{hello:e,state:n}=t;e&&e!==this.known&&(this.known=e,ks(this.session,e.sessions.map(s=>[s.id,s.name]),t.scene?.session??""),Ae(this.person,H("bar.person",{person:e.person,role:hs("role",e.role)}))),t.scene&&document.activeElement!==this.session&&this.session.value!==t.scene.session&&(this.session.value=t.scene.session),Ae(this.phase,n?hs("phase",n.phase):""),as(this.phase,"data-phase",n?.phase??null),Ae(this.time,n?ss(n.t):""),Ae(this.link,H(`link.${t.link}`)),as(this.link,"data-link",t.link);for(const s of this.tabs){const a={live:null,instructor:null,evaluator:"score",seat:"seat",desk:"create"}[s.dataset.view];s.classList.toggle("denied",a!==null&&!t.granted(a))}}}const bm="tandem";function rw(){try{const i=JSON.parse(localStorage.getItem(bm)??"{}");return typeof i=="object"&&i!==null?i:{}}catch{return{}}}function aw(){const i=rw();return{language:i.language==="en"||i.language==="fr"?i.language:gg(navigator.languages),theme:i.theme==="light"||i.theme==="dark"?i.theme:"auto",keys:i.keys!==!1}}function ow(i){try{localStorage.setItem(bm,JSON.stringify(i))}catch{}}class lw{constructor(){this.context=null,this.own=null,this.touching=[],this.nextLimit=0}get on(){return this.context!==null}switch(t){t!==this.on&&(t?this.context=new AudioContext:(this.context?.close(),this.context=null,this.own=null))}update(t,e,n){const s=this.touching;if(this.touching=t.tools.map(a=>a.touching===!0),!this.context)return;this.touching.some((a,o)=>a&&s[o]===!1)&&this.beep(190,.08,.25),t.seats.some((a,o)=>jh(a,e?.seats[o]))&&n>=this.nextLimit&&(this.nextLimit=n+500,this.beep(980,.06,.12))}ownForce(t){const e=this.context;if(!e)return;if(!this.own){const s=new OscillatorNode(e,{type:"sine",frequency:220}),r=new GainNode(e,{gain:0});s.connect(r).connect(e.destination),s.start(),this.own={tone:s,gain:r}}const n=Math.min(1,Math.max(0,t??0));this.own.tone.frequency.setTargetAtTime(180+360*n,e.currentTime,.03),this.own.gain.gain.setTargetAtTime(.12*n,e.currentTime,.03)}beep(t,e,n){const s=this.context;if(!s)return;const r=new OscillatorNode(s,{type:"sine",frequency:t}),a=new GainNode(s,{gain:n});a.gain.setTargetAtTime(0,s.currentTime+e*.5,e*.2),r.connect(a).connect(s.destination),r.start(),r.stop(s.currentTime+e*2)}}const cw=100;class hw{constructor(t,e,n){this.model=t,this.connection=e,this.root=n,this.sound=new lw,this.settings=aw(),this.messages=new Ud,this.bar=null,this.control=null,this.views=new Map,this.current="live",this.main=z("main",{id:"main",tabindex:-1}),this.join=null,this.prefilled=Eg(location.hash),this.lastNotice=null,this.updated_ms=0,this.dark=matchMedia("(prefers-color-scheme: dark)"),this.prefilled&&history.replaceState(null,"","/"),Oo(this.settings.language),this.host=new KE(t),e.onChange=()=>this.onChange(),this.dark.addEventListener("change",()=>this.paint()),document.addEventListener("keydown",s=>this.onKey(s)),this.build(),requestAnimationFrame(s=>this.onFrame(s)),setInterval(()=>{document.hidden&&this.update()},1e3)}get pictureHost(){return this.host.node}order(t,e){return this.request(t,{type:"order",...e})}async request(t,e){const n=await this.connection.request(e);return n.ok?this.report("info",H("order.sent",{what:t})):this.report("error",H("order.refused",{what:t,why:n.text})),n}report(t,e){this.messages.show(t,e)}build(){document.documentElement.lang=this.settings.language,this.messages=new Ud,this.bar=new sw(this,this.settings,{choose:t=>this.choose(t),change:t=>this.change(t)}),this.control=new wg(this),this.views=new Map([["live",new tS(this,this.host.picture)],["instructor",new oE(this)],["evaluator",new Fg(this)],["seat",new nw(this)],["desk",new Cg(this)]]),this.main=z("main",{id:"main",tabindex:-1}),this.root.replaceChildren(z("a",{class:"skip",href:"#main"},H("nav.skip")),this.bar.node,this.control.node,this.main,this.messages.node),this.paint(),this.choose(this.current),this.onChange()}change(t){this.settings={...this.settings,...t},ow(this.settings),t.language&&(Oo(t.language),this.host.picture?.canvas.setAttribute("aria-label",H("picture.label")),this.join=null,this.build()),this.paint()}paint(){const{theme:t}=this.settings;document.documentElement.dataset.theme=t==="auto"?this.dark.matches?"dark":"light":t,this.host.picture?.recolour()}choose(t){this.views.get(this.current)?.hidden?.(),this.current=t;const e=this.views.get(t);e&&(this.main.replaceChildren(e.node),e.shown?.(),this.bar?.choose(t),this.update())}onChange(){const{model:t}=this;t.link==="refused"?(this.join??=new lE(this.prefilled,()=>this.connection.reconnect()),this.join.node.isConnected||this.main.replaceChildren(this.join.node)):t.link==="open"&&this.join&&(this.join=null,this.prefilled=null,this.choose(this.current));const e=t.notices.newest;e&&e!==this.lastNotice&&(this.lastNotice=e,this.report(e.level,e.text)),this.update()}update(){this.bar?.update(),this.control?.update(),this.host.update(this.model.states.sample(performance.now())),this.join||this.views.get(this.current)?.update()}onFrame(t){requestAnimationFrame(s=>this.onFrame(s));const e=performance.now(),n=this.model.states.sample(e);this.host.frame(n,t),this.connection.acknowledge(),n&&this.sound.update(n.state,this.model.scene,e),this.join||this.views.get(this.current)?.frame?.(n,e),e-this.updated_ms>=cw&&(this.updated_ms=e,this.update())}onKey(t){if(!this.settings.keys||t.ctrlKey||t.altKey||t.metaKey||t.repeat)return;const e=t.target;if(e instanceof HTMLElement&&(e.matches("input:not([type=range]):not([type=checkbox]):not([type=radio]), textarea, select")||e.closest("dialog")!==null)||this.join)return;const s=t.key.toLowerCase(),r=wm[Number(s)-1];if(s==="s")this.control?.order("stop");else if(s==="p")this.control?.order("pause");else if(s==="r")this.control?.order("resume");else if(s==="m")this.views.get("evaluator")?.timeline.mark();else if(r)this.choose(r);else return;t.preventDefault()}}const uw=200,fw=1;class dw{constructor(){this.alarms=[],this.active=new Map,this.counts=new Map,this.next=1}list(){return[...this.alarms].reverse()}current(){return[...this.active.values()].map(t=>t.alarm)}update(t,e){const n=this.causes(t,e);for(const s of n)this.see(s,t.t);for(const[s,r]of this.active)r.alarm.kind!=="connection"&&(t.t-r.seen>fw||t.t<r.seen)&&this.end(s,t.t)}connection(t,e,n){const s="connection:";t?this.see({kind:"connection",level:"alarm",seat:"",detail:n},e):this.active.has(s)&&this.end(s,e)}end(t,e){const n=this.active.get(t);n&&(n.alarm.until=e??n.alarm.t??0,this.active.delete(t))}see(t,e){const n=`${t.kind}:${t.seat}`,s=this.active.get(n);if(s){s.seen=e??s.seen,s.alarm.detail=t.detail||s.alarm.detail;return}const r={number:this.next++,...t,t:e,until:null};this.alarms.push(r),this.active.set(n,{alarm:r,seen:e??0}),this.alarms.length>uw&&this.alarms.shift()}causes(t,e){const n=[],s=(r,a,o,l="")=>{n.push({kind:r,level:a,seat:o,detail:l})};if(t.stop){const r=t.stop.kind==="FAULT";s(r?"fault":"stopped",r||t.stop.kind==="STOP"?"alarm":"warning",t.stop.by,t.stop.why)}return t.shed>0&&s("shed","warning","",String(t.shed)),t.seats.forEach((r,a)=>{const o=e?.seats[a],l=o?.name??String(a+1);if(this.increased(`trips:${l}`,r.trips)&&s("trip","alarm",l,String(r.trips)),this.increased(`late:${l}`,r.late)&&s("late","warning",l,String(r.late)),r.taken===!0){if(r.heard===!1)return s("lost","alarm",l);kp(r.gate)==="red"&&s("gate","alarm",l,r.gate??""),jh(r,o)&&s("clipping","warning",l),ph(r)==="red"&&s("link","alarm",l),Np(r.margin_j)==="red"&&s("margin","warning",l),Op(r.temperature_c)==="red"&&s("hot","alarm",l)}}),n}increased(t,e){if(e===null)return!1;const n=this.counts.get(t);return(this.counts.size<4*24||n!==void 0)&&this.counts.set(t,e),n!==void 0&&e>n}}const pw=.05;function Tm(i,t,e){return i===null||t===null||!(Math.hypot(t[0]-i[0],t[1]-i[1],t[2]-i[2])<=pw)?t:[i[0]+(t[0]-i[0])*e,i[1]+(t[1]-i[1])*e,i[2]+(t[2]-i[2])*e]}function Am(i,t,e){return i===null||t===null?t:[i[0]+(t[0]-i[0])*e,i[1]+(t[1]-i[1])*e,i[2]+(t[2]-i[2])*e]}function mw(i,t,e){return i===void 0||i.person!==t.person?t:{...t,x:Tm(i.x,t.x,e),f:Am(i.f,t.f,e)}}function gw(i,t,e){return i===void 0?t:{...t,x:Tm(i.x,t.x,e),f:Am(i.f,t.f,e)}}function _w(i,t,e){return e>=1||i.seats.length!==t.seats.length||i.tools.length!==t.tools.length?t:{...t,t:i.t+(t.t-i.t)*e,seats:t.seats.map((n,s)=>mw(i.seats[s],n,e)),tools:t.tools.map((n,s)=>gw(i.tools[s],n,e))}}const vw=8,Hd=1e3/60,xw=60,Mw=1e-4,yw=500;class Sw{constructor(){this.states=new Ra(vw),this.offset=null,this.offsetAt=0,this.interval=Hd,this.roundTrip=0,this.roundTripKnown=!1,this.skipped=0,this.received=0,this.drawn=-1}get newest(){return this.states.newest?.state??null}clear(){this.states.clear(),this.offset=null,this.interval=Hd,this.drawn=-1}addRoundTrip(t){t>=0&&(this.roundTrip=this.roundTripKnown?Math.min(this.roundTrip,t):t,this.roundTripKnown=!0)}push(t,e){this.received+=1;const n=this.states.newest;n&&t.n<=n.state.n&&this.clear();const s=this.states.newest;s&&s.state.n>this.drawn&&(this.skipped+=1);const r=t.wall_us===null?e:t.wall_us/1e3,a=e-r;if(this.offset===null?this.offset=a:this.offset=Math.min(a,this.offset+Math.max(0,e-this.offsetAt)*Mw),this.offsetAt=e,s){const o=r-s.wall_ms;o>0&&o<1e3&&(this.interval+=(o-this.interval)*.1)}this.states.push({state:t,wall_ms:r,received_ms:e})}sample(t){const e=this.states.newest;if(e===void 0||this.offset===null)return null;this.drawn=e.state.n;const n=t-this.offset,s=n-Math.min(xw,this.interval*1.2),[r,a]=this.stateAt(s,e),o=Math.max(0,t-e.received_ms);return{state:r,delay_ms:Math.max(0,n-a)+this.roundTrip/2,silence_ms:o,outOfDate:o>yw}}stateAt(t,e){if(t>=e.wall_ms)return[e.state,e.wall_ms];for(let s=this.states.length-1;s>0;s-=1){const r=this.states.at(s),a=this.states.at(s-1);if(!r||!a||a.wall_ms>t)continue;const o=r.wall_ms-a.wall_ms,l=o>0?(t-a.wall_ms)/o:1;return[_w(a.state,r.state,l),a.wall_ms+o*l]}const n=this.states.at(0)??e;return[n.state,n.wall_ms]}}const Ew=500,ww=50;class bw{constructor(){this.link="connecting",this.hello=null,this.scene=null,this.notes=null,this.ownSeat=null,this.tickets=null,this.states=new Sw,this.acknowledgements=new $m,this.alarms=new dw,this.history=new rS,this.events=new Ra(Ew),this.notices=new Ra(ww),this.revision=0}get state(){return this.states.newest}may(t){return this.link==="open"&&this.granted(t)}granted(t){return this.hello?.may.includes(t)??!1}apply(t,e){switch(t.type){case"hello":this.hello=t,this.revision+=1;break;case"scene":this.scene?.session!==t.session&&this.beginSession(),this.scene=t,this.revision+=1;break;case"state":this.states.push(t,e),this.acknowledgements.received(t.n,t.dropped),this.alarms.update(t,this.scene),this.history.update(t,this.scene);break;case"event":this.isRepeated(t)||this.events.push(t);break;case"notice":this.notices.push(t);break;case"seat":this.ownSeat=t;break;case"notes":this.notes=t,this.revision+=1;break;case"tickets":this.tickets=t,this.revision+=1;break}}connected(){this.link="open",this.states.clear(),this.acknowledgements.reset(),this.alarms.connection(!1,this.state?.t??null,"")}disconnected(t,e){this.link=t,this.ownSeat=null,this.alarms.connection(!0,this.state?.t??null,e)}beginSession(){this.states.clear(),this.history.clear(),this.events.clear(),this.notes=null,this.ownSeat=null}isRepeated(t){for(let e=this.events.length-1;e>=0;e-=1){const n=this.events.at(e);if(n?.session===t.session&&n.number===t.number&&n.text===t.text)return!0}return!1}}const Rm=document.getElementById("page");if(!Rm)throw new Error('index.html has no element "page"');const Cm=new bw,Pm=new _g(Cm);new hw(Cm,Pm,Rm);Pm.connect();
