declare const RUN: {
  folder: string;
  first: string[];
  needs: { [name: string]: string };
  bytes: { [name: string]: number };
  env: { [name: string]: string };
  files: { [name: string]: [bytes: number, transferred: number, sha256: string] }; // for worker.js
  hashes: { [path: string]: string }; // for service_worker.js
  others: string[]; // paths of what has no hash
};
declare module "*.py" {
  const source: string;
  export default source;
}
