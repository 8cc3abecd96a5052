import type { Page, View } from '../app/page';
import {
  allTo,
  guidance,
  instructorIndex,
  kAnnouncementTicks,
  kShareRange,
  mastersOf,
  sameShares,
  traineeIndices,
  typedShare,
  withShare,
} from '../logic/authority';
import { kUnknown, percent } from '../logic/format';
import type { Scene, SceneSeat } from '../protocol/messages';
import { t, word } from '../strings/strings';
import { button, el, fillSelect, labelled, panel, select, setAttribute, setDisabled, setText } from './dom';
import { swatch } from './value_table';

interface Row {
  slider: HTMLInputElement;
  draft: HTMLElement;
  wanted: HTMLElement;
  applied: HTMLElement;
  bar: HTMLProgressElement;
}

/** Authority of one tool: sliders, presets and hand-over, with the applied beside the wanted share. */
export class AuthorityPanel implements View {
  readonly node: HTMLElement;
  private readonly tools = select([['0', '']], '0', () => this.discard());
  private readonly toolField = labelled(t('authority.tool'), this.tools);
  private readonly rows = el('div', { class: 'shares' });
  private readonly presets = el('div', { class: 'row presets' });
  private readonly to = select([], '', () => undefined);
  private readonly share = el('input', {
    type: 'number',
    min: kShareRange[0],
    max: kShareRange[1],
    step: 5,
    value: '100',
    oninput: () => setAttribute(this.share, 'aria-invalid', null),
  });
  private readonly apply: HTMLButtonElement;
  private readonly reset: HTMLButtonElement;
  private readonly give: HTMLButtonElement;
  private readonly transfer = el('p', { class: 'transfer', role: 'status' });
  private readonly draftNote = el('p', { class: 'note' });
  private readonly denied = el('p', { class: 'note', role: 'status' });
  private sliders: Row[] = [];
  private masters: SceneSeat[] = [];
  private known: Scene | null = null;
  /** Shares that the person moved but did not apply. */
  private draft: number[] | null = null;

  constructor(private readonly page: Page) {
    this.apply = button(t('authority.apply'), () => this.send(t('authority.title'), this.draft), { class: 'primary' });
    this.reset = button(t('authority.reset'), () => this.discard());
    this.give = button(t('authority.give'), () => this.handOver());
    this.node = panel(
      t('authority.title'),
      'authority-panel',
      this.denied,
      this.toolField,
      this.rows,
      el('div', { class: 'row' }, this.apply, this.reset, this.draftNote),
      el('h3', {}, t('authority.presets')),
      this.presets,
      el('h3', {}, t('authority.hand_over')),
      el(
        'div',
        { class: 'row' },
        labelled(t('who.seat'), this.to),
        labelled(`${t('authority.share')} (%)`, this.share),
        this.give,
      ),
      this.transfer,
      el('p', { class: 'note' }, t('authority.explain', { ticks: kAnnouncementTicks })),
    );
  }

  update(): void {
    const { model } = this.page;
    if (model.scene && model.scene !== this.known) this.adopt(model.scene);
    const tool = model.state?.tools[this.tool()];
    const wanted = tool?.wanted ?? null;
    const applied = tool?.applied ?? null;
    if (sameShares(this.draft, wanted)) this.draft = null;
    const may = model.may('authority') && wanted !== null;
    this.sliders.forEach((row, i) => {
      const shown = (this.draft ?? wanted)?.[i];
      if (this.draft === null && document.activeElement !== row.slider && shown !== undefined) {
        row.slider.value = String(Math.round(shown * 100));
      } else if (this.draft !== null && shown !== undefined) {
        row.slider.value = String(Math.round(shown * 100));
      }
      row.slider.setAttribute('aria-valuetext', percent(shown));
      setText(row.draft, percent(shown));
      setText(row.wanted, percent(wanted?.[i]));
      setText(row.applied, percent(applied?.[i]));
      row.bar.value = applied?.[i] ?? 0;
      setDisabled(row.slider, !may);
    });
    setText(this.draftNote, this.draft ? t('authority.draft') : '');
    setDisabled(this.apply, !may || this.draft === null);
    setDisabled(this.reset, this.draft === null);
    setDisabled(this.give, !may || this.masters.length < 2);
    setDisabled(this.to, !may);
    setDisabled(this.share, !may);
    this.denied.hidden = !model.hello || model.granted('authority');
    setText(
      this.denied,
      this.denied.hidden ? '' : t('authority.denied', { role: word('role', model.hello?.role ?? '') }),
    );
    this.toolField.hidden = this.tools.options.length < 2;
    for (const preset of this.presets.children) setDisabled(preset as HTMLButtonElement, !may);
    const transfer = tool?.transfer ?? null;
    setText(
      this.transfer,
      transfer
        ? t('authority.transfer', {
            by: transfer.by,
            to: transfer.to,
            alpha: percent(transfer.alpha),
            ticks: transfer.ticks ?? kUnknown,
          })
        : t('authority.no_transfer'),
    );
    this.transfer.classList.toggle('announced', transfer !== null);
  }

  private tool(): number {
    return Number(this.tools.value) || 0;
  }

  private discard(): void {
    this.draft = null;
    this.update();
  }

  private handOver(): void {
    const index = Number(this.to.value);
    const share = typedShare(this.share.value);
    if (share === null) {
      const [min, max] = kShareRange;
      setAttribute(this.share, 'aria-invalid', 'true');
      this.share.focus();
      const why = t('authority.share_range', { min, max });
      return this.page.report('error', t('order.refused', { what: t('authority.give'), why }));
    }
    const wanted = this.page.model.state?.tools[this.tool()]?.wanted;
    if (!wanted) return;
    this.send(t('authority.give'), withShare(wanted, index, share));
  }

  private send(what: string, alpha: readonly number[] | null): void {
    const version = this.page.model.state?.version;
    if (!alpha || version === undefined) return;
    void this.page.order(what, { order: 'authority', tool: this.tool(), version, alpha }).then((reply) => {
      if (reply.ok) this.draft = null;
    });
  }

  private adopt(scene: Scene): void {
    this.known = scene;
    this.draft = null;
    this.masters = mastersOf(scene);
    fillSelect(
      this.tools,
      scene.tools.map((tool, i) => [String(i), tool.name] as const),
      this.tools.value,
    );
    const instructor = instructorIndex(this.masters);
    fillSelect(
      this.to,
      this.masters.map((seat, i) => [String(i), seat.name] as const),
      String(traineeIndices(this.masters)[0] ?? 0),
    );
    this.sliders = [];
    this.rows.replaceChildren(
      el(
        'div',
        { class: 'share head', 'aria-hidden': 'true' },
        el('span'),
        el('span'),
        el('span'),
        el('span', {}, t('authority.wanted')),
        el('span', {}, t('authority.applied')),
      ),
      ...this.masters.map((seat, i) => this.row(seat, i, scene)),
    );
    const all =
      (index: number): (() => void) =>
      () =>
        this.preset(allTo(this.masters.length, index));
    const name = t('authority.demonstration');
    this.presets.replaceChildren(
      button(name, all(instructor)),
      button(t('authority.guidance'), () => this.preset(guidance(this.masters))),
      ...traineeIndices(this.masters).map((i) =>
        button(t('authority.evaluation', { seat: this.masters[i]?.name ?? '' }), all(i)),
      ),
    );
  }

  private preset(alpha: number[]): void {
    this.send(t('authority.presets'), alpha);
  }

  private row(seat: SceneSeat, index: number, scene: Scene): HTMLElement {
    const slider = el('input', {
      type: 'range',
      min: 0,
      max: 100,
      step: 5,
      'aria-label': t('authority.share_of', { seat: seat.name }),
      oninput: () => {
        const base = this.draft ?? this.page.model.state?.tools[this.tool()]?.wanted;
        if (base) this.draft = withShare(base, index, Number(slider.value) / 100);
        this.update();
      },
    });
    const bar = el('progress', { max: 1, 'aria-label': `${seat.name}: ${t('authority.applied')}` });
    const [draft, wanted, applied] = [el('span', { class: 'draft' }), el('span'), el('span')];
    this.sliders.push({ slider, draft, wanted, applied, bar });
    const label = (text: string): HTMLElement => el('span', { class: 'visually-hidden' }, `${text}: `);
    return el(
      'div',
      { class: 'share' },
      el('span', { class: 'name' }, swatch(scene.seats.indexOf(seat)), seat.name),
      slider,
      draft,
      el('span', { class: 'number' }, label(t('authority.wanted')), wanted),
      el('span', { class: 'number applied' }, label(t('authority.applied')), applied, bar),
    );
  }
}
