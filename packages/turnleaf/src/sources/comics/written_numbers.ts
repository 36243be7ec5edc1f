/** Numbers in names of files as East Asian books write them, for the order of these names. */

/** Digits and powers of ten in Chinese characters, also as contracts write them; volumes in two or three. */
const digits = "〇一二三四五六七八九";
const formal = "零壹贰叁肆伍陆柒捌玖";
const formalJapanese = "零壱弐参四五六七八九";
const powers: Readonly<Record<string, number>> = {
  ...{ 十: 10, 拾: 10, 百: 100, 千: 1000, 万: 10_000, 萬: 10_000 },
};

const run = /[〇零一二三四五六七八九壹贰叁肆伍陆柒捌玖壱弐参十拾百千万萬]+/g;

/** A volume's name that is nothing else, and stands alone between others: upper, middle, lower. */
const volume = /(?<!\p{L})(?:上|中|下)(?:巻|卷|册|冊)?(?!\p{L})/gu;

/** Returns a name with its numbers in digits: of Chinese characters, in circles, in full width. */
export function withDigits(name: string): string {
  return name
    .normalize("NFKC")
    .replace(run, (number) => String(countOf(number)))
    .replace(volume, (part) => String("上中下".indexOf(part.charAt(0)) + 1));
}

/** Returns what a number stands for: "十二" and "一二" alike are 12. */
function countOf(number: string): number {
  let [whole, section, digit] = [0, 0, 0];
  for (const letter of number) {
    const power = powers[letter];
    if (power === undefined) digit = 10 * digit + digitOf(letter);
    else if (power === 10_000) {
      whole += (section + digit || 1) * power;
      [section, digit] = [0, 0];
    } else {
      section += (digit || 1) * power;
      digit = 0;
    }
  }
  return whole + section + digit;
}

function digitOf(letter: string): number {
  return Math.max(digits.indexOf(letter), formal.indexOf(letter), formalJapanese.indexOf(letter));
}
