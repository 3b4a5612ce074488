// What the page shows comes from the viewer that holds it in a frame: numbers as they are, and no text of them.

const given = parent.clsmithViewer.given;
const facts = given.facts;

const readArrays = async () => given.arrays;

// The text of the listing.
const readText = async () => given.arrays.text;
