// Prints what Khronos' glTF validator finds in a file, as JSON: node validate_gltf.js MODULES FILE
const fs = require("fs");
const [modules, file] = process.argv.slice(2);
require(`${modules}/gltf-validator`)
  .validateBytes(new Uint8Array(fs.readFileSync(file)), { maxIssues: 0 })
  .then((report) => console.log(JSON.stringify(report.issues)))
  .catch((error) => {
    console.error(String(error));
    process.exit(1);
  });
