// Builds the page that a run leaves: src/ with its libraries in one file, source/output/report_template.html.
import {build} from 'esbuild';
import {readFileSync, writeFileSync} from 'node:fs';

const here = new URL('.', import.meta.url).pathname;
const result = await build({
  entryPoints: [here + 'src/main.js'],
  bundle: true,
  minify: true,
  format: 'iife',
  target: 'es2020',
  legalComments: 'none',
  metafile: true,
  write: false,
});
const packages = new Set(Object.keys(result.metafile.inputs).map(path => (/node_modules\/([^/]+)/.exec(path) || [])[1]).filter(Boolean));
const licences = [...packages].sort().map(name => {
  const {version} = JSON.parse(readFileSync(`${here}node_modules/${name}/package.json`));
  return `${name} ${version}\n${readFileSync(`${here}node_modules/${name}/LICENSE`)}`;
});
const parts = {
  style: readFileSync(here + 'src/style.css', 'utf8'),
  script: result.outputFiles[0].text,
  licences: licences.join('\n').replace(/-->/g, '-- >'),
};
if (/<!--|<\/script/i.test(parts.script)) throw new Error('the script would end the element that it stands in');
const page = readFileSync(here + 'src/template.html', 'utf8').replace(/<!-- (style|script|licences) -->/g, (_, name) => parts[name]);
writeFileSync(here + '../../source/output/report_template.html', page);
console.log(`source/output/report_template.html: ${page.length} characters`);
