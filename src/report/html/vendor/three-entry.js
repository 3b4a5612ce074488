// What the page takes from three.js; `update.sh` makes three.iife.min.js of it.
export {
  AmbientLight, Box3, BufferAttribute, BufferGeometry, Color, ColorManagement, DirectionalLight, DoubleSide, Group,
  LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, MeshLambertMaterial, OrthographicCamera, Plane, Quaternion, Scene,
  Vector3, WebGLRenderer,
} from "three";
export { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
