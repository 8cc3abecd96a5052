import type { Page, View } from '../app/page';
import { deskDenial } from '../logic/desk_denial';
import { clock } from '../logic/format';
import { kPeopleMax, lessonMistakes, type Lesson, type LessonMistake } from '../logic/lesson';
import { kNameMax } from '../protocol/names';
import { t, word } from '../strings/strings';
import { button, el, labelled, nameField, panel, setAttribute, setDisabled, setText } from './dom';
import { GivenPanels } from './given_panels';
import { PersonRows } from './person_rows';
import { endSession } from './session_end';

/** The lesson desk: creates sessions with their people, ends them, and shows a card with ticket and steps per person. */
export class DeskView implements View {
  readonly node: HTMLElement;
  private readonly rule = el('p', { class: 'note', id: 'name-rule' }, t('desk.name_rule', { max: kNameMax }));
  private readonly scene = nameField(this.rule, { list: 'scenes', required: true, oninput: () => this.onScene() });
  private readonly scenes = el('datalist', { id: 'scenes' });
  private readonly duration = el('p', { class: 'note', id: 'scene-end', role: 'status' });
  private readonly name = nameField(this.rule, { required: true });
  private readonly people = new PersonRows(2, this.rule);
  private readonly problem = el('p', { class: 'problem', id: 'desk-problem' });
  private readonly fields = el('fieldset', { class: 'plain' });
  private readonly denied = el('p', { class: 'note', id: 'desk-denied', role: 'status' });
  private readonly shownSession = el('p', { id: 'shown-session' });
  private readonly end: HTMLButtonElement;
  private readonly given: GivenPanels;
  private invalid: HTMLInputElement | undefined;
  private revision = -1;

  constructor(private readonly page: Page) {
    this.given = new GivenPanels(page);
    this.end = button('', () => void this.endShown(), { class: 'danger' });
    this.fields.setAttribute('aria-describedby', this.denied.id);
    this.fields.append(
      el(
        'div',
        { class: 'row' },
        labelled(t('desk.scene'), this.scene),
        this.scenes,
        labelled(t('desk.name'), this.name),
      ),
      this.duration,
      this.rule,
      el('h3', {}, t('desk.people')),
      el('p', { class: 'note' }, t('desk.proposed')),
      this.people.node,
      this.problem,
      el(
        'div',
        { class: 'row' },
        button(t('desk.add'), () => this.people.add().focus()),
        el('button', { type: 'submit', class: 'primary' }, t('desk.create')),
      ),
    );
    const form = el(
      'form',
      {
        novalidate: true, // the page says the rule in words of its own
        onsubmit: (event) => {
          event.preventDefault();
          this.send();
        },
      },
      this.fields,
    );
    this.node = el(
      'div',
      { class: 'view desk-view' },
      panel(t('desk.title'), 'desk-panel', this.denied, form, el('p', { class: 'note' }, t('desk.begins'))),
      panel(t('desk.shown_title'), 'shown-panel', this.shownSession, el('div', { class: 'row' }, this.end)),
      this.given.node,
    );
  }

  update(): void {
    const { model } = this.page;
    const may = model.may('create');
    if (this.fields.disabled === may) this.fields.disabled = !may;
    setText(this.denied, this.reason());
    this.denied.hidden = may;
    this.updateShown(may);
    if (model.revision !== this.revision) {
      this.revision = model.revision;
      this.scenes.replaceChildren(
        ...(model.hello?.scenes ?? []).map((value) => el('option', { value, label: this.endOf(value) || value })),
      );
      this.people.setWorkstation(model.hello?.workstation ?? '');
      this.onScene();
    }
    this.given.update();
  }

  private updateShown(may: boolean): void {
    const { scene, state, left } = this.page.model;
    const name = scene?.name ?? '';
    setText(
      this.shownSession,
      scene === null
        ? t('desk.none_shown')
        : [
            t('desk.shown', { name }),
            state ? word('phase', state.phase) : '',
            left === null ? '' : t('bar.left', { t: clock(left) }),
          ]
            .filter(Boolean)
            .join(', '),
    );
    setText(this.end, t('desk.end_of', { name }));
    this.end.hidden = scene === null;
    setDisabled(this.end, !may || state?.phase === 'OVER');
  }

  /** Why the fields are disabled; empty: they are not. */
  private reason(): string {
    const { model } = this.page;
    if (model.may('create')) return '';
    if (model.granted('create') || !model.hello) return t('order.no_connection');
    return t(deskDenial(model.hello), { role: word('role', model.hello.role) });
  }

  /** Name of a scene and when its sessions end; empty: the page does not know that. */
  private endOf(scene: string): string {
    const { hello } = this.page.model;
    const duration = hello?.sceneDurations.get(scene);
    if (duration !== undefined) return t('desk.ends_after', { scene, t: clock(duration) });
    return hello?.sceneSeats.has(scene) ? t('desk.endless', { scene }) : '';
  }

  private onScene(): void {
    const scene = this.scene.value.trim();
    this.people.setSeats(this.page.model.hello?.sceneSeats.get(scene) ?? kNoSeats);
    setText(this.duration, this.endOf(scene));
  }

  private endShown(): Promise<void> {
    const { scene } = this.page.model;
    return scene ? endSession(this.page, scene.session, scene.name) : Promise.resolve();
  }

  private send(): void {
    const lesson: Lesson = {
      scene: this.scene.value.trim(),
      name: this.name.value.trim(),
      people: this.people.people(),
    };
    const mistake = lessonMistakes(lesson)[0];
    this.mark(mistake);
    if (!mistake) void this.page.order(t('desk.create'), { order: 'create', ...lesson });
  }

  private fieldOf({ field, index }: LessonMistake): HTMLInputElement | undefined {
    if (field === 'scene') return this.scene;
    if (index === null) return field === 'name' ? this.name : undefined;
    return this.people.field(index, field === 'seat' || field === 'workstation' ? field : 'name');
  }

  /** Says a mistake beside the field and as a message; undefined: there is none. */
  private mark(mistake: LessonMistake | undefined): void {
    if (this.invalid) setAttribute(this.invalid, 'aria-invalid', null);
    this.invalid = mistake && this.fieldOf(mistake);
    setText(this.problem, '');
    if (!mistake) return;
    const { invalid } = this;
    const field = invalid?.closest('label')?.firstElementChild?.textContent ?? t('desk.people');
    const words = { field, value: invalid?.value ?? '', max: mistake.why === 'many' ? kPeopleMax : kNameMax };
    setText(this.problem, t(`desk.mistake_${mistake.why}`, words));
    this.page.report('error', this.problem.textContent ?? '');
    if (!invalid) return;
    setAttribute(invalid, 'aria-invalid', 'true');
    invalid.focus();
  }
}

const kNoSeats: readonly never[] = [];
