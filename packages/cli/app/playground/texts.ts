/** The texts of the page, in each of its languages. */

import type { LeafStockName } from "turnleaf/models";
import type { Settings } from "./settings.ts";
import type { Variant } from "./variants.ts";

/** All texts. Words in {braces} are placeholders. */
export interface Texts {
  readonly title: string;
  readonly intro: string;
  readonly models: readonly [string, string];
  readonly picture: string;
  readonly variants: Readonly<Record<Variant, string>>;
  readonly names: Readonly<Record<keyof Settings, string>>;
  readonly groups: Readonly<
    Record<"paper" | "world" | "model" | "shown" | "keep" | "creases", string>
  >;
  readonly creases: Readonly<
    Record<
      "page" | "ear" | "half" | "rest" | "live" | "remove" | "note" | "none" | "rejected",
      string
    >
  >;
  /** What no stock is, and how a stock is listed. */
  readonly stocks: Readonly<Record<"own" | "preset", string>>;
  /** The names of stocks, where these are not the words by which a page chooses them. */
  readonly stockNames: Readonly<Partial<Record<LeafStockName, string>>>;
  readonly preset: string;
  readonly turns: Readonly<Record<"edge" | "corner" | "let-go", string>>;
  readonly pause: string;
  readonly resume: string;
  readonly step: string;
  readonly paces: Readonly<Record<"1" | "0.25" | "0.1", string>>;
  readonly ownNumber: string;
  readonly aSecond: string;
  readonly states: Readonly<Record<"still" | "paused" | "real" | "slower", string>>;
  readonly plots: Readonly<Record<"energy" | "strain" | "cost", string>>;
  readonly figures: Readonly<Record<"energy" | "strain" | "cost", string>>;
  readonly notes: Readonly<Record<"shell" | "springs", string>>;
  readonly record: string;
  readonly stop: string;
  readonly copy: string;
  readonly copied: string;
  readonly notCopied: string;
  readonly picturePng: string;
  readonly settingsJson: string;
  readonly files: string;
  readonly replayError: string;
  readonly badLink: string;
  readonly badLinkAt: string;
  readonly noLeaf: string;
  readonly notFinite: string;
  readonly notRecorded: string;
}

const en: Texts = {
  title: "Turnleaf playground",
  intro: "Two models, one page, one hand: drag either leaf, or let both play the same turn.",
  models: ["Model of the first leaf", "Model of the second leaf"],
  picture:
    "{model}. Drag the leaf; or press Enter to take its corner, the arrow keys to move it, Enter to let go.",
  variants: {
    "paper-2014": "The paper's leaf of 2014",
    springs: "Masses and springs, classic",
    "springs-synchronised": "Springs, synchronised",
    "springs-interpolated": "Springs, interpolated",
    "springs-both": "Springs, synchronised and interpolated",
    sheet: "Sheet (the book's own)",
    replay: "Replay of the sheet",
    "sheet-synchronised": "Sheet, synchronised",
    shell: "Shell (reference)",
    "shell-triangles": "Shell of triangles",
    rigid: "Board that swings",
    peel: "Peel (flat fold)",
    cylinder: "Cylinder",
    cone: "Cone",
  },
  names: {
    left: "First model",
    right: "Second model",
    grammage: "Grammage",
    caliper: "Caliper",
    stiffness: "Stiffness",
    gravity: "Gravity",
    air: "Air",
    angle: "Dog-ear angle",
    nodes: "Nodes",
    steps: "Steps",
    seconds: "Turn takes",
    pace: "Time",
    masses: "Masses",
    springs: "Springs",
    lines: "Dog-ear lines",
    strain: "Strain",
    creases: "Creases",
  },
  groups: {
    paper: "Paper",
    world: "World",
    model: "Models",
    shown: "Shown",
    keep: "Keep",
    creases: "Creases of the sheet",
  },
  creases: {
    page: "The flat page, its spine at the left: draw a line to crease the sheet along it.",
    ear: "Dog-ear",
    half: "In half",
    rest: "Rest of {n}",
    live: "now {angle}, rests at {rest}, moment a length {moment}",
    remove: "Remove crease {n}",
    note: "Draw lines on the page; none may meet the spine. Pulled more than 29° off its rest, a crease rests anew.",
    none: "Only the sheet can be creased; choose it on either side.",
    rejected: "The sheet was not creased so. {reason}",
  },
  stocks: {
    own: "As set below",
    preset: "{name}, {grammage} g/m²",
  },
  stockNames: {},
  preset: "Stock",
  turns: { edge: "Turn by edge", corner: "Turn by corner", "let-go": "Let go half-way" },
  pause: "Pause",
  resume: "Go on",
  step: "One step",
  paces: { "1": "Real time", "0.25": "Slow, 1/4", "0.1": "Slow, 1/10" },
  ownNumber: "own",
  aSecond: "{n}/s",
  states: {
    still: "At rest: nothing is computed or drawn.",
    paused: "Paused.",
    real: "In real time.",
    slower: "{n} times slower than real time.",
  },
  plots: { energy: "Energy", strain: "Strain", cost: "Cost of a step" },
  figures: {
    energy:
      "{model}: motion {kinetic} (whole line), bending {bending} (dashed), height {gravity} (dotted)",
    strain: "{model}: stretched {stretch}, pressed {compression}",
    cost: "{model}: {cost} a step of {step} ms, {fraction} of real time",
  },
  notes: {
    shell:
      "The shell's own grid has 33 × 45 nodes, and takes minutes for a turn; here it has 10 × 14 where nobody chose.",
    springs:
      "Of a model without springs, the edges between its nodes. Strain: red is stretched, blue pressed together; full at {full}.",
  },
  record: "Record",
  stop: "Stop recording",
  copy: "Copy link",
  copied: "The link is copied.",
  notCopied: "The browser does not let the link be copied; take it from the address bar.",
  picturePng: "Picture (PNG)",
  settingsJson: "Settings (JSON)",
  files: "Files to keep",
  replayError: "replay within {error} of the width",
  badLink: "The link was ignored: it is none of this page's.",
  badLinkAt: "The link was ignored: its value for “{name}” is none that can be set here.",
  noLeaf: "These settings make no leaf, so the ones before still move: {reason}",
  notFinite: "A model broke down with these settings; its leaf was laid flat again.",
  notRecorded: "The recording could not be kept; record a shorter one.",
};

const zh: Texts = {
  title: "Turnleaf 试验台",
  intro: "两种模型，同一页纸，同一只手：拖动任一张纸，或让两张纸做同样的翻页。",
  models: ["第一张纸的模型", "第二张纸的模型"],
  picture: "{model}。拖动纸页；或按回车抓住页角，用方向键移动，再按回车松手。",
  variants: {
    "paper-2014": "2014 年论文的纸页",
    springs: "经典质点弹簧",
    "springs-synchronised": "质点弹簧，同步",
    "springs-interpolated": "质点弹簧，插值",
    "springs-both": "质点弹簧，同步加插值",
    sheet: "薄页（本书所用）",
    replay: "薄页的回放",
    "sheet-synchronised": "薄页，同步",
    shell: "薄壳（参照）",
    "shell-triangles": "三角形薄壳",
    rigid: "刚性板",
    peel: "平面剥离",
    cylinder: "圆柱",
    cone: "圆锥",
  },
  names: {
    left: "第一模型",
    right: "第二模型",
    grammage: "克重",
    caliper: "厚度",
    stiffness: "刚度",
    gravity: "重力",
    air: "空气",
    angle: "折角线角度",
    nodes: "节点",
    steps: "步数",
    seconds: "翻页用时",
    pace: "时间",
    masses: "质点",
    springs: "弹簧",
    lines: "折角平行线",
    strain: "应变",
    creases: "折痕",
  },
  groups: {
    paper: "纸张",
    world: "环境",
    model: "模型",
    shown: "显示",
    keep: "保存",
    creases: "薄页的折痕",
  },
  creases: {
    page: "展平的纸页，书脊在左：画一条线，薄页便沿线折叠。",
    ear: "折角",
    half: "对折",
    rest: "折痕 {n} 静止角",
    live: "现为 {angle}，静止于 {rest}，单位长度力矩 {moment}",
    remove: "去掉折痕 {n}",
    note: "用指针在纸页上画线，不可碰到书脊。手若把折痕拉离静止角超过 29°，静止角随之改变。",
    none: "只有薄页可以折叠；请在任一侧选择它。",
    rejected: "薄页不能这样折叠。{reason}",
  },
  stocks: {
    own: "如下设定",
    preset: "{name}，{grammage} g/m²",
  },
  stockNames: {
    bible: "圣经纸",
    book: "书纸",
    office: "复印纸",
    coated: "铜版纸",
    card: "卡纸",
  },
  preset: "纸种",
  turns: { edge: "由边翻页", corner: "由角翻页", "let-go": "半途松手" },
  pause: "暂停",
  resume: "继续",
  step: "单步",
  paces: { "1": "实时", "0.25": "慢放 1/4", "0.1": "慢放 1/10" },
  ownNumber: "自定",
  aSecond: "{n}/秒",
  states: {
    still: "静止：不计算，也不绘制。",
    paused: "已暂停。",
    real: "实时。",
    slower: "比实时慢 {n} 倍。",
  },
  plots: { energy: "能量", strain: "应变", cost: "每步开销" },
  figures: {
    energy: "{model}：动能 {kinetic}（实线），弯曲 {bending}（虚线），重力 {gravity}（点线）",
    strain: "{model}：拉伸 {stretch}，压缩 {compression}",
    cost: "{model}：每步 {cost}，步长 {step} ms，占实时 {fraction}",
  },
  notes: {
    shell: "薄壳自身的网格为 33 × 45，翻一页需数分钟；未选择时此处用 10 × 14。",
    springs: "没有弹簧的模型显示节点间的边。应变：红为拉伸，蓝为压缩，{full} 时颜色最深。",
  },
  record: "录制",
  stop: "停止录制",
  copy: "复制链接",
  copied: "链接已复制。",
  notCopied: "浏览器不允许复制链接，请从地址栏复制。",
  picturePng: "图片（PNG）",
  settingsJson: "设置（JSON）",
  files: "可保存的文件",
  replayError: "重放误差不超过页宽的 {error}",
  badLink: "链接被忽略：它不属于本页。",
  badLinkAt: "链接被忽略：“{name}”的值无法在此设定。",
  noLeaf: "这些设置不能构成纸页，仍用之前的设置：{reason}",
  notFinite: "有一个模型在这些设置下失稳，其纸页已重新放平。",
  notRecorded: "录制内容无法保存，请录短一些。",
};

/** Returns the texts for a language, or English. */
export function textsFor(language: string): {
  readonly language: "en" | "zh";
  readonly texts: Texts;
} {
  return /^zh\b/i.test(language) ? { language: "zh", texts: zh } : { language: "en", texts: en };
}

/** Returns a text with its placeholders filled in. */
export const fill = (text: string, values: Readonly<Record<string, string>>): string =>
  text.replace(/\{(\w+)\}/g, (all, name) => (Object.hasOwn(values, name) ? values[name] : all));
