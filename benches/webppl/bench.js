// SMC on one WebPPL program; prints one JSON line, the same that the limit prints.
//   node bench.js WEBPPL_FOLDER hmm|branching DATA.json|- PARTICLES SECONDS SEED
// Steps are particle-steps: calls that drew choices and met a factor. Seconds are CPU seconds of this
// process; compilation and a first run, which warms the just-in-time compiler, are left out.
'use strict';
var fs = require('fs');
var path = require('path');
var [folder, program, data, particles, seconds, seed] = process.argv.slice(2);
folder = path.resolve(folder);
var webppl = require(path.join(folder, 'src/main'));
require(path.join(folder, 'src/util')).seedRNG(+seed);

var ticks = 0;
global.bench = { particles: +particles, tick: function() { ticks += 1; } };
if (data !== '-') global.data = JSON.parse(fs.readFileSync(data, 'utf8'));

function cpuSeconds() {
  var usage = process.cpuUsage();
  return (usage.user + usage.system) / 1e6;
}

var source = fs.readFileSync(path.join(__dirname, program + '.wppl'), 'utf8') +
    "\nInfer({model: model, method: 'SMC', particles: bench.particles, onlyMAP: true}).normalizationConstant;";
var found = null;
var runner = webppl.prepare(webppl.compile(source, { filename: program + '.wppl' }), function(store, value) {
  found = value;
  return null;
});

runner.run();
ticks = 0;
var start = cpuSeconds(), evidence = [];
while (cpuSeconds() - start < +seconds) {
  runner.run();
  evidence.push(found);
}
// The chain has no tick of its own, which would cost it a little: its number of steps is known.
var steps = program === 'hmm' ? evidence.length * particles * global.data.observations.length : ticks;
console.log(JSON.stringify({
  system: 'webppl', program: program, particles: +particles, seed: +seed, steps: steps,
  cpu_seconds: cpuSeconds() - start, log_evidence: evidence
}));
