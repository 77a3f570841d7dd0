declare const RUN: {
  version: string;
  folder: string;
  first: string[];
  needs: { [name: string]: string };
  bytes: { [name: string]: number };
  env: { [name: string]: string };
  files: { [name: string]: [bytes: number, transferred: number, sha256: string] }; // for worker.js
  hashes: { [path: string]: string }; // for service_worker.js
};
declare module "*.py" {
  const source: string;
  export default source;
}
