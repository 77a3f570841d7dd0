declare const RUN: {
  version: string;
  folder: string;
  first: string[];
  needs: { [name: string]: string };
  bytes: { [name: string]: number };
  env: { [name: string]: string };
};
declare module "*.py" {
  const source: string;
  export default source;
}
