// Prints what Khronos' glTF validator says about a file, as JSON: node validate.js MODULE FILE
const fs = require("fs");
const [module_, file] = process.argv.slice(2);
require(module_)
  .validateBytes(new Uint8Array(fs.readFileSync(file)), { maxIssues: 0 })
  .then((report) => console.log(JSON.stringify(report.issues)))
  .catch((error) => {
    console.error(String(error));
    process.exit(1);
  });
